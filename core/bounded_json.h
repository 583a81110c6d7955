#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <stdexcept>
#include <string>
#include <string_view>

/// Parses untrusted JSON: checks every limit while reading, before it allocates memory for a
/// value. Writes JSON from strings of any bytes.
namespace farol {

struct JsonLimits {
    std::size_t bytes = 0;          ///< of the whole text
    std::size_t depth = 8;          ///< of arrays and objects inside each other
    std::size_t keys = 1'000;       ///< of one object
    std::size_t values = 10'000;    ///< numbers, strings, literals, arrays and objects together
    std::size_t stringBytes = 200;  ///< of one string, one key or the digits of one number
};

/// The text is no JSON, or exceeds a limit. The message names the place.
class JsonError : public std::runtime_error {
  public:
    enum class Reason {
        syntax,     ///< RFC 8259, or a number that a double cannot hold
        limit,      ///< one of JsonLimits
        duplicate,  ///< a key occurs twice in one object
    };
    JsonError(Reason reason, const std::string& message)
        : std::runtime_error(message), reason_(reason) {}
    Reason reason() const { return reason_; }

  private:
    Reason reason_;
};

/// Parses one JSON value. Throws JsonError.
nlohmann::json parseJson(std::string_view text, const JsonLimits& limits);
/// The same; keys keep their order.
nlohmann::ordered_json parseOrderedJson(std::string_view text, const JsonLimits& limits);

/// JSON as text, `indent` blanks a level or on one line (-1). A byte that belongs to no UTF-8
/// character becomes U+FFFD.
template <typename Json>
std::string dumpJson(const Json& value, int indent = -1) {
    return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace farol
