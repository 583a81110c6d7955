#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/enum_words.h"
#include "core/error.h"
#include "core/text.h"
#include "grade/messages.h"

/// Three visitors of a rubric's description (describe in rubric.cpp): one reads a document, one
/// writes it, one writes its JSON schema. Each has the same members, so that a key stands once.
namespace farol::grade {

using nlohmann::json;
using nlohmann::ordered_json;

/// Returns a bound of numbers in its short form: 16, 0.01.
ordered_json bound(double value);

inline constexpr std::size_t kMaxRubricText = 200;  ///< bytes; the rest is cut off

/// Reads one object of the document; `end` refuses keys that were not asked for. Null stands for a
/// key that is not there. Errors name the value by its JSON pointer (RFC 6901), also in `field`.
class RubricReader {
  public:
    static constexpr bool kReads = true, kWrites = false;

    /// Gives a message of a rubric its form in another document's family of codes.
    using Rename = Message (*)(Message message);

    RubricReader(const json& value, std::string path, const std::string& file,
                 Rename rename = nullptr);

    void comment(const std::string& key) { has(key); }
    void text(const std::string& key, std::string& out, const char* = "");
    /// A text that is needed and not empty.
    void requiredText(const std::string& key, std::string& out, const char* = "");
    void flag(const std::string& key, bool& out, const char* = "");
    void flag(const std::string& key, std::optional<bool>& out, const char* = "");
    /// A list of different words among `words`.
    void someOf(const std::string& key, std::vector<std::string>& out,
                const std::vector<std::string_view>& words, const char*);
    void number(const std::string& key, double& out, double least, double most, const char* = "");
    void integer(const std::string& key, int& out, int least, int most, const char* = "");
    void integer(const std::string& key, std::optional<int>& out, int least, int most);
    /// A power of two.
    void samples(const std::string& key, int& out, int most, const char*);
    template <typename Enum, Enum kLast>
    void word(const std::string& key, std::optional<Enum>& out, const EnumWords<Enum, kLast>& words,
              const char*) {
        if (has(key)) out = static_cast<Enum>(place(key, {words.all().begin(), words.all().end()}));
    }
    template <typename Enum, Enum kLast>
    void word(const std::string& key, Enum& out, const EnumWords<Enum, kLast>& words, const char*) {
        if (has(key)) out = static_cast<Enum>(place(key, {words.all().begin(), words.all().end()}));
    }
    /// The place of a required word among `words`.
    std::size_t requiredWord(const std::string& key, std::size_t,
                             const std::vector<std::string_view>& words);
    void numbers(const std::string& key, std::vector<double>& out, std::size_t fewest,
                 std::size_t most, double least, double greatest, const char*);
    /// Numbers by keys of any name.
    void numbersByKey(const std::string& key, std::map<std::string, double>& out, double least,
                      double most, const char*);
    template <typename Each>
    void object(const std::string& key, Each each) {
        if (!has(key)) return;
        RubricReader inner(value_.at(key), at(key), file_, rename_);
        each(inner);
        inner.end();
    }
    /// An object that need not be there; where it is, it begins as `usual`.
    template <typename Value, typename Each>
    void maybe(const std::string& key, std::optional<Value>& out, const Value& usual, const char*,
               Each each) {
        if (!has(key)) return;
        RubricReader inner(value_.at(key), at(key), file_, rename_);
        out = usual;
        each(inner, *out);
        inner.end();
    }
    /// Objects that begin as `usual`; `each` takes the form, an element and its place.
    template <typename Value, typename Each>
    void list(const std::string& key, std::vector<Value>& out, const Value& usual,
              std::size_t fewest, std::size_t most, const char*, Each each) {
        if (!has(key)) return;
        const json& all = listAt(key, fewest, most);
        out.clear();
        for (std::size_t i = 0; i < all.size(); ++i) {
            RubricReader inner(all[i], at(key) + "/" + std::to_string(i), file_, rename_);
            out.push_back(usual);
            each(inner, out.back(), i);
            inner.end();
        }
    }
    /// Refuses the document unless `ok`, with a message that has {path}; without a key the path
    /// is this object's.
    template <FixedString kId, FixedString... kNames>
    void require(bool ok, const std::string& key, const NamedArgument<kNames>&... more) const {
        if (!ok) fail<kId>(at(key), more...);
    }
    /// Refuses the document unless `ok`: the word `value` of the key is none of `known`.
    void requireKnown(bool ok, const std::string& key, const std::string& value,
                      const std::vector<std::string>& known) const;
    void end() const;

  private:
    bool has(const std::string& key);
    double asNumber(const json& value, const std::string& path, double least, double most) const;
    std::size_t place(const std::string& key, const std::vector<std::string_view>& words);
    [[noreturn]] void failWord(const std::string& path, const std::string& value,
                               const std::vector<std::string_view>& words) const;
    const json& listAt(const std::string& key, std::size_t fewest, std::size_t most) const;
    std::string at(const std::string& key) const;
    template <FixedString kId, FixedString... kNames>
    [[noreturn]] void fail(const std::string& path, const NamedArgument<kNames>&... more) const {
        const std::string& named = path.empty() ? kWhole : path;
        Message fault = message<kId>("path"_arg = named, more...);
        throw Error(rename_ ? rename_(std::move(fault)) : std::move(fault), {file_, 0, 0}, path);
    }
    static inline const std::string kWhole = "the rubric";

    const json& value_;
    std::string path_;
    const std::string& file_;
    const Rename rename_;
    std::set<std::string> known_;
};

/// Writes every key of a rubric; null where nothing is set.
class RubricWriter {
  public:
    static constexpr bool kReads = false, kWrites = true;

    void comment(const std::string&) {}
    void text(const std::string& key, const std::string& value, const char* = "") {
        out[key] = value;
    }
    void requiredText(const std::string& key, const std::string& value, const char* = "") {
        out[key] = value;
    }
    void flag(const std::string& key, bool value, const char* = "") { out[key] = value; }
    void flag(const std::string& key, const std::optional<bool>& value, const char* = "") {
        out[key] = value ? ordered_json(*value) : ordered_json();
    }
    void someOf(const std::string& key, const std::vector<std::string>& values,
                const std::vector<std::string_view>&, const char*) {
        out[key] = values.empty() ? ordered_json() : ordered_json(values);
    }
    void number(const std::string& key, double value, double, double, const char* = "") {
        out[key] = value;
    }
    void integer(const std::string& key, int value, int, int, const char* = "") {
        out[key] = value;
    }
    void integer(const std::string& key, const std::optional<int>& value, int, int) {
        out[key] = value ? ordered_json(*value) : ordered_json();
    }
    void samples(const std::string& key, int value, int, const char*) { out[key] = value; }
    template <typename Enum, Enum kLast>
    void word(const std::string& key, const std::optional<Enum>& value,
              const EnumWords<Enum, kLast>& words, const char*) {
        out[key] = value ? ordered_json(words[*value]) : ordered_json();
    }
    template <typename Enum, Enum kLast>
    void word(const std::string& key, const Enum& value, const EnumWords<Enum, kLast>& words,
              const char*) {
        out[key] = words[value];
    }
    std::size_t requiredWord(const std::string& key, std::size_t value,
                             const std::vector<std::string_view>& words) {
        out[key] = words[value];
        return value;
    }
    void numbers(const std::string& key, const std::vector<double>& values, std::size_t,
                 std::size_t, double, double, const char*) {
        out[key] = values.empty() ? ordered_json() : ordered_json(values);
    }
    void numbersByKey(const std::string& key, const std::map<std::string, double>& values, double,
                      double, const char*) {
        out[key] = values;
    }
    template <typename Each>
    void object(const std::string& key, Each each) {
        RubricWriter inner;
        each(inner);
        out[key] = std::move(inner.out);
    }
    template <typename Value, typename Each>
    void maybe(const std::string& key, std::optional<Value>& value, const Value&, const char*,
               Each each) {
        out[key] = nullptr;
        if (!value) return;
        RubricWriter inner;
        each(inner, *value);
        out[key] = std::move(inner.out);
    }
    template <typename Value, typename Each>
    void list(const std::string& key, std::vector<Value>& values, const Value&, std::size_t,
              std::size_t, const char*, Each each) {
        ordered_json all = ordered_json::array();
        for (std::size_t i = 0; i < values.size(); ++i) {
            RubricWriter inner;
            each(inner, values[i], i);
            all.push_back(std::move(inner.out));
        }
        out[key] = std::move(all);
    }
    template <FixedString kId, FixedString... kNames>
    void require(bool, const std::string&, const NamedArgument<kNames>&...) const {}
    void requireKnown(bool, const std::string&, const std::string&,
                      const std::vector<std::string>&) const {}

    ordered_json out = ordered_json::object();
};

/// Writes the schema of one object (JSON Schema 2020-12).
class RubricSchema {
  public:
    static constexpr bool kReads = false, kWrites = false;

    void comment(const std::string& key) { add(key, {{"type", "string"}}); }
    void text(const std::string& key, const std::string&, const char* about = "");
    void requiredText(const std::string& key, const std::string&, const char* about = "");
    void flag(const std::string& key, bool, const char* about = "") {
        add(key, {{"type", "boolean"}}, about);
    }
    void flag(const std::string& key, const std::optional<bool>&, const char* about = "") {
        add(key, {{"type", {"boolean", "null"}}}, about);
    }
    void someOf(const std::string& key, const std::vector<std::string>&,
                const std::vector<std::string_view>& words, const char* about);
    void number(const std::string& key, double, double least, double most, const char* about = "") {
        add(key, numberRule(least, most), about);
    }
    void integer(const std::string& key, int, int least, int most, const char* about = "");
    void integer(const std::string& key, const std::optional<int>&, int least, int most);
    void samples(const std::string& key, int, int most, const char* about);
    template <typename Enum, Enum kLast>
    void word(const std::string& key, const std::optional<Enum>&,
              const EnumWords<Enum, kLast>& words, const char* about) {
        ordered_json all = ordered_json::array({nullptr});
        for (const std::string_view word : words.all()) all.push_back(word);
        add(key, {{"enum", std::move(all)}}, about);
    }
    template <typename Enum, Enum kLast>
    void word(const std::string& key, const Enum& usual, const EnumWords<Enum, kLast>& words,
              const char* about) {
        add(key, {{"enum", words.all()}, {"default", words[usual]}}, about);
    }
    std::size_t requiredWord(const std::string& key, std::size_t value,
                             const std::vector<std::string_view>& words);
    void numbers(const std::string& key, const std::vector<double>&, std::size_t fewest,
                 std::size_t most, double least, double greatest, const char* about);
    void numbersByKey(const std::string& key, const std::map<std::string, double>&, double least,
                      double most, const char* about);
    template <typename Each>
    void object(const std::string& key, Each each) {
        RubricSchema inner;
        each(inner);
        add(key, inner.rule());
    }
    template <typename Value, typename Each>
    void maybe(const std::string& key, const std::optional<Value>&, const Value& usual,
               const char* about, Each each) {
        RubricSchema inner;
        Value value = usual;
        each(inner, value);
        ordered_json rule = inner.rule();
        rule["type"] = {"object", "null"};
        add(key, std::move(rule), about);
    }
    template <typename Value, typename Each>
    void list(const std::string& key, const std::vector<Value>&, const Value& usual,
              std::size_t fewest, std::size_t most, const char* about, Each each) {
        RubricSchema inner;
        Value value = usual;
        each(inner, value, 0);
        add(key, listRule({{"type", "array"}}, fewest, most, about, inner.rule()));
    }
    template <FixedString kId, FixedString... kNames>
    void require(bool, const std::string&, const NamedArgument<kNames>&...) const {}
    void requireKnown(bool, const std::string&, const std::string&,
                      const std::vector<std::string>&) const {}

    /// The object's rule.
    ordered_json rule() const;

  private:
    void add(const std::string& key, ordered_json rule, const char* about = "");
    static ordered_json numberRule(double least, double most);
    static ordered_json listRule(ordered_json rule, std::size_t fewest, std::size_t most,
                                 const char* about, ordered_json items);

    ordered_json properties_ = ordered_json::object(), required_ = ordered_json::array();
};

}  // namespace farol::grade
