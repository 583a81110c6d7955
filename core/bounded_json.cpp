#include "core/bounded_json.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

namespace farol {
namespace {

/// Reads the text for the parser and records how far it has read: the parser reports its position
/// only for syntax errors.
class Cursor {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    Cursor() = default;
    Cursor(const char* at, const char** furthest) : at_(at), furthest_(furthest) {}
    reference operator*() const { return *at_; }
    Cursor& operator++() {
        *furthest_ = ++at_;
        return *this;
    }
    Cursor operator++(int) {
        const Cursor before = *this;
        ++*this;
        return before;
    }
    bool operator==(const Cursor& other) const { return at_ == other.at_; }

  private:
    const char* at_ = nullptr;
    const char** furthest_ = nullptr;
};

/// Builds a value from the parser's events. An event that exceeds a limit ends the parse.
template <typename Json>
class Builder {
  public:
    Builder(std::string_view text, const JsonLimits& limits, const char** furthest)
        : text_(text), limits_(limits), furthest_(furthest) {}

    bool null() { return put(nullptr); }
    bool boolean(bool value) { return put(value); }
    bool number_integer(std::int64_t value) { return put(value); }
    bool number_unsigned(std::uint64_t value) { return put(value); }
    bool number_float(double value, const std::string& digits) {
        return fitsString(digits) && put(value);
    }
    bool string(std::string& value) { return fitsString(value) && put(std::move(value)); }
    bool binary(std::vector<std::uint8_t>&) { return false; }  // no part of JSON as text
    bool start_object(std::size_t) { return open(Json::object()); }
    bool start_array(std::size_t) { return open(Json::array()); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }
    bool key(std::string& name) {
        if (!fitsString(name)) return false;
        if (open_.back()->size() >= limits_.keys)
            return fail(JsonError::Reason::limit,
                        "an object has more than " + std::to_string(limits_.keys) + " keys");
        if (open_.back()->contains(name))
            return fail(JsonError::Reason::duplicate, "the key \"" + name + "\" occurs twice");
        key_ = std::move(name);
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& fault) {
        constexpr int kNumberOutOfRange = 406;
        return fail(JsonError::Reason::syntax, fault.id == kNumberOutOfRange
                                                   ? "the number is out of range"
                                                   : "this is not valid JSON");
    }

    bool fail(JsonError::Reason reason, const std::string& message) {
        if (error_) return false;
        const auto read = text_.substr(0, static_cast<std::size_t>(*furthest_ - text_.data()));
        const auto line = 1 + std::count(read.begin(), read.end(), '\n');
        const std::size_t column = read.size() - (read.rfind('\n') + 1);
        error_.emplace(reason, "line " + std::to_string(line) + ", column " +
                                   std::to_string(std::max<std::size_t>(1, column)) + ": " +
                                   message);
        return false;
    }
    const std::optional<JsonError>& error() const { return error_; }
    Json take() { return std::move(root_); }

  private:
    bool fitsString(const std::string& value) {
        return value.size() <= limits_.stringBytes ||
               fail(JsonError::Reason::limit,
                    "a string or number of " + std::to_string(value.size()) + " bytes; at most " +
                        std::to_string(limits_.stringBytes) + " are allowed");
    }
    template <typename Value>
    Json* insert(Value&& value) {
        if (++values_ > limits_.values) {
            fail(JsonError::Reason::limit,
                 "more than " + std::to_string(limits_.values) + " values");
            return nullptr;
        }
        if (open_.empty()) {
            root_ = std::forward<Value>(value);
            return &root_;
        }
        Json& parent = *open_.back();
        if (parent.is_array()) {
            parent.push_back(Json(std::forward<Value>(value)));
            return &parent.back();
        }
        return &(parent[key_] = std::forward<Value>(value));
    }
    template <typename Value>
    bool put(Value&& value) {
        return insert(std::forward<Value>(value)) != nullptr;
    }
    bool open(Json container) {
        if (open_.size() >= limits_.depth)
            return fail(JsonError::Reason::limit, "arrays and objects are nested deeper than " +
                                                      std::to_string(limits_.depth) + " levels");
        Json* const inserted = insert(std::move(container));
        if (inserted == nullptr) return false;
        open_.push_back(inserted);
        return true;
    }
    bool close() {
        open_.pop_back();
        return true;
    }

    const std::string_view text_;
    const JsonLimits& limits_;
    const char** const furthest_;
    Json root_;
    // A container grows only while it is the innermost one, so that no pointer here dangles.
    std::vector<Json*> open_;
    std::string key_;
    std::size_t values_ = 0;
    std::optional<JsonError> error_;
};

template <typename Json>
Json parse(std::string_view text, const JsonLimits& limits) {
    const char* furthest = text.data();
    Builder<Json> builder(text, limits, &furthest);
    if (text.size() > limits.bytes) {
        builder.fail(JsonError::Reason::limit, "the text has " + std::to_string(text.size()) +
                                                   " bytes; at most " +
                                                   std::to_string(limits.bytes) + " are allowed");
        throw JsonError(*builder.error());
    }
    const bool isWhole = Json::sax_parse(Cursor(text.data(), &furthest),
                                         Cursor(text.data() + text.size(), &furthest), &builder);
    if (builder.error()) throw JsonError(*builder.error());
    if (!isWhole) throw JsonError(JsonError::Reason::syntax, "this is not valid JSON");
    return builder.take();
}

}  // namespace

nlohmann::json parseJson(std::string_view text, const JsonLimits& limits) {
    return parse<nlohmann::json>(text, limits);
}

nlohmann::ordered_json parseOrderedJson(std::string_view text, const JsonLimits& limits) {
    return parse<nlohmann::ordered_json>(text, limits);
}

}  // namespace farol
