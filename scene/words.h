#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Small text helpers of the reader. ASCII only: names of the language have no other letters.
namespace farol::scene {

char lowerCase(char c);
std::string lowerCase(std::string_view text);
bool sameWord(std::string_view a, std::string_view b);  ///< case-insensitive
bool isBlank(char c);
std::string_view trimmed(std::string_view text);

/// The words between blanks.
std::vector<std::string_view> split(std::string_view text);

/// `text` in double quotes for a message: at most 60 bytes, cut between UTF-8 characters, control
/// characters as blanks.
std::string quoted(std::string_view text);
std::string shown(std::string_view text);  ///< the same without the quotes

/// The part of a path after the last slash or backslash.
std::string_view baseName(std::string_view path);

}  // namespace farol::scene
