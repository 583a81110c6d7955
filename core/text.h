#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

/// Text helpers shared by all folders. Letters, digits and blanks are ASCII in any locale.
namespace farol {

constexpr bool isDigit(char c) { return c >= '0' && c <= '9'; }
constexpr bool isAlphanumeric(char c) {
    return isDigit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// Bytes that are no capital letter A to Z stay as they are.
char lowerCase(char c);
std::string lowerCase(std::string_view text);
bool sameWord(std::string_view a, std::string_view b);  ///< case-insensitive

inline constexpr std::string_view kBlanks = " \t\n\r";
inline constexpr std::string_view kLineBlanks = " \t";  ///< within a line; OWS of RFC 9110
bool isBlank(char c);                                   ///< of kBlanks
/// The text without `blanks` at both ends.
std::string_view trimmed(std::string_view text, std::string_view blanks = kBlanks);

/// The words between `separators`, none of them empty.
std::vector<std::string_view> split(std::string_view text, std::string_view separators = kBlanks);

/// The elements' texts with `separator` between them: "1, 2, 3". `textOf` turns an element into
/// something that a std::string takes with +=.
template <typename Range, typename TextOf = std::identity>
std::string joined(const Range& range, std::string_view separator, TextOf textOf = {}) {
    std::string text;
    bool isFirst = true;
    for (const auto& element : range) {
        if (!isFirst) text += separator;
        isFirst = false;
        text += textOf(element);
    }
    return text;
}

/// `text` in double quotes for a message: at most 60 bytes, cut between UTF-8 characters, control
/// characters as blanks.
std::string quoted(std::string_view text);
std::string shown(std::string_view text);  ///< the same without the quotes

/// Whether the text is UTF-8 (RFC 3629: no overlong forms, no surrogates, at most U+10FFFF).
bool isUtf8(std::string_view text);
/// The text with each byte that belongs to no UTF-8 character replaced by U+FFFD.
std::string toUtf8(std::string_view text);
/// The text's bytes, read as ISO 8859-1.
std::string latin1ToUtf8(std::string_view text);
/// Returns UTF-8 as it is, and else the text's bytes read as ISO 8859-1: the name of a file from
/// another system.
std::string nameToUtf8(std::string_view name);

/// The part of a path after the last slash or backslash.
std::string_view baseName(std::string_view path);
/// Returns the text after the last dot of the base name, in lower case: "png". "" without a dot,
/// also of a name that begins with its only dot.
std::string fileEnding(std::string_view path);

}  // namespace farol
