#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// The message catalogue. Each floor has tables of rows (FLOOR/messages.h): an id, the English
/// template, samples. Code names a row by its id and gives the arguments by their names; both are
/// checked by the compiler. docs/how-to/contributor-extend.md, "A message", has the steps.
namespace farol {

/// The value of one placeholder. `id` names the row of an argument that is itself a message; the
/// arguments of that message follow in the list as "name.inner".
struct MessageArgument {
    std::string name;
    std::string text;  ///< English, at most kMaxArgumentBytes
    std::string id;
    bool operator==(const MessageArgument&) const = default;
};
using MessageArguments = std::vector<MessageArgument>;

inline constexpr std::size_t kMaxPlaceholders = 8;      ///< of one row
inline constexpr std::size_t kMaxArguments = 24;        ///< of one message, inner ones included
inline constexpr std::size_t kMaxArgumentBytes = 1000;  ///< of one value

/// One row of a catalogue. In the template, {name} stands for an argument; a part in brackets is
/// left out if an argument in it is empty: "no element <{name}>[; did you mean \"{suggestion}\"?]".
struct MessageRow {
    /// "code" or "code/variant"; "part.name" for a message that is only an argument of others.
    std::string_view id;
    std::string_view text;
    /// Values for tests and documents, in the order in which the placeholders first appear.
    std::array<std::string_view, kMaxPlaceholders> samples{};
};

/// A row with its arguments.
struct Message {
    std::string id;
    std::string text;  ///< English
    MessageArguments arguments;

    bool empty() const { return id.empty(); }
    /// The public code: the id without its variant.
    std::string code() const { return id.substr(0, id.find('/')); }
};

/// The placeholders of a template in the order in which they first appear; the rest are empty.
constexpr std::array<std::string_view, kMaxPlaceholders> placeholdersOf(std::string_view text) {
    std::array<std::string_view, kMaxPlaceholders> names{};
    std::size_t count = 0;
    for (std::size_t at = text.find('{'); at != std::string_view::npos;
         at = text.find('{', at + 1)) {
        const std::string_view name = text.substr(at + 1, text.find('}', at) - at - 1);
        bool isKnown = false;
        for (std::size_t i = 0; i < count; ++i) isKnown = isKnown || names[i] == name;
        if (!isKnown && count < kMaxPlaceholders) names[count++] = name;
    }
    return names;
}

/// Finds the template of an id, in English or another language.
using FindTemplate = std::function<std::optional<std::string_view>(std::string_view id)>;

/// Returns the template with its placeholders replaced. Arguments that are messages are rendered
/// by `find` where it has their template, else their English text is used. A placeholder without
/// an argument becomes empty: nothing throws.
std::string renderTemplate(std::string_view text, const MessageArguments& arguments,
                           const FindTemplate& find = {});

/// Returns the row's samples as arguments.
MessageArguments sampleArguments(const MessageRow& row);

/// A value longer than the 60 bytes that other values are cut to: a path, a list of words.
struct Uncut {
    std::string_view text;
};
inline Uncut uncut(std::string_view text) { return {text}; }

struct Diagnostic;

/// The text of a fixed string as a template argument.
template <std::size_t N>
struct FixedString {
    char text[N];
    // NOLINTNEXTLINE(google-explicit-constructor): literals convert.
    consteval FixedString(const char (&from)[N]) : text{} {
        for (std::size_t i = 0; i < N; ++i) text[i] = from[i];
    }
    constexpr std::string_view view() const { return {text, N - 1}; }
};

namespace detail {
MessageArguments argumentOf(std::string_view name, std::string_view value);
MessageArguments argumentOf(std::string_view name, Uncut value);
MessageArguments argumentOf(std::string_view name, double value);
MessageArguments argumentOf(std::string_view name, const Message& value);
MessageArguments argumentOf(std::string_view name, const Diagnostic& value);
template <std::integral Number>
MessageArguments argumentOf(std::string_view name, Number value) {
    return argumentOf(name, std::string_view(std::to_string(value)));
}

Message buildMessage(const MessageRow& row, std::initializer_list<MessageArguments> arguments);

/// Nothing if no table has such an id. (A pointer to the row is no constant under g++ 12's
/// sanitizers.)
constexpr std::optional<MessageRow> findRow(
    std::initializer_list<std::span<const MessageRow>> tables, std::string_view id) {
    for (const std::span<const MessageRow> table : tables)
        for (const MessageRow& row : table)
            if (row.id == id) return row;
    return std::nullopt;
}
constexpr bool hasPlaceholder(std::string_view text, std::string_view name) {
    for (const std::string_view placeholder : placeholdersOf(text))
        if (placeholder == name) return true;
    return false;
}
constexpr std::size_t countPlaceholders(std::string_view text) {
    std::size_t count = 0;
    for (const std::string_view placeholder : placeholdersOf(text)) count += placeholder != "";
    return count;
}
constexpr bool areDistinct(std::initializer_list<std::string_view> names) {
    for (const auto* a = names.begin(); a != names.end(); ++a)
        for (const auto* b = a + 1; b != names.end(); ++b)
            if (*a == *b) return false;
    return true;
}
}  // namespace detail

template <FixedString kName>
struct NamedArgument {
    MessageArguments value;
};

template <FixedString kName>
struct ArgumentName {
    /// Takes text (cut to 60 bytes), `uncut` text, a number, a Message or a Diagnostic.
    template <typename Value>
    NamedArgument<kName> operator=(const Value& value) const {
        return {detail::argumentOf(kName.view(), value)};
    }
};

/// Names an argument: message<"scene.empty">("element"_arg = name).
template <FixedString kName>
consteval ArgumentName<kName> operator""_arg() {
    return {};
}

/// Returns the message of a row of `kTables`. A wrong id, and a missing, surplus or misspelt
/// argument, do not compile. Each floor wraps it with its tables (FLOOR/messages.h).
template <FixedString kId, const auto&... kTables, FixedString... kNames>
Message makeMessage(const NamedArgument<kNames>&... arguments) {
    static constexpr std::optional<MessageRow> kRow = detail::findRow({kTables...}, kId.view());
    static_assert(kRow.has_value(), "the table has no row with this id");
    if constexpr (kRow.has_value()) {
        static_assert((detail::hasPlaceholder(kRow->text, kNames.view()) && ...),
                      "an argument that the template has no placeholder for");
        static_assert(detail::areDistinct({kNames.view()...}), "an argument is given twice");
        static_assert(sizeof...(kNames) == detail::countPlaceholders(kRow->text),
                      "an argument of the template is missing");
        return detail::buildMessage(*kRow, {arguments.value...});
    }
}

}  // namespace farol
