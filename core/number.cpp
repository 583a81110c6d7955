#include "core/number.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/messages.h"
#include "core/text.h"

namespace farol {
namespace {

/// True if a number that from_chars calls "out of range" is too small, by the exponent's sign.
bool underflows(std::string_view digits) {
    const std::size_t e = digits.find_first_of("eE");
    if (e == std::string_view::npos) return digits.find_first_of("123456789") > digits.find('.');
    return e + 1 < digits.size() && digits[e + 1] == '-';
}

Message notNumber(std::string_view suggestion) {
    return coreMessage<"part.number-not">("suggestion"_arg = suggestion);
}

Message tooLarge() { return coreMessage<"part.number-large">("max"_arg = kHugeNumber); }

}  // namespace

ParsedNumber parseNumber(std::string_view text) {
    const std::string_view word = trimmed(text);
    std::string_view rest = word;
    if (rest.empty()) return {0.0, coreMessage<"part.number-empty">()};
    if (rest.front() == '+') {
        rest.remove_prefix(1);
        if (!rest.empty() && rest.front() == '-') return {0.0, notNumber("")};
    }
    double value = 0.0;
    const auto [end, failed] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
    const std::string_view read(rest.data(), static_cast<std::size_t>(end - rest.data()));
    const std::string_view left = rest.substr(read.size());
    if (failed == std::errc::invalid_argument) return {0.0, notNumber("")};
    if (!left.empty() && left.front() == ',') {
        std::string suggestion(word);
        std::replace(suggestion.begin(), suggestion.end(), ',', '.');
        return {0.0, coreMessage<"part.number-comma">("suggestion"_arg = suggestion)};
    }
    if (!left.empty() && !sameWord(left, "f")) {
        const auto isLetter = [](char c) {
            return static_cast<unsigned char>(c) >= 0x80 ||
                   (lowerCase(c) >= 'a' && lowerCase(c) <= 'z');
        };
        const bool unit = std::all_of(left.begin(), left.end(), isLetter);  // "60deg", "5s"
        return {0.0, notNumber(unit ? read : "")};
    }
    if (failed == std::errc::result_out_of_range) {
        if (underflows(read)) return {0.0, {}};
        return {0.0, tooLarge()};
    }
    if (!std::isfinite(value)) return {0.0, coreMessage<"part.number-infinite">()};
    if (std::abs(value) > kHugeNumber) return {0.0, tooLarge()};
    if (std::abs(value) < double{std::numeric_limits<float>::min()}) value = 0.0;
    return {value, {}};
}

std::string formatNumber(double value) {
    if (value == 0.0) return "0";   // also the negative zero
    constexpr double kPlain = 1e9;  // whole numbers up to it without an exponent: 100000, not 1e+05
    char digits[32];
    const bool plain = std::abs(value) <= kPlain && value == std::floor(value);
    const auto [end, failed] =
        plain ? std::to_chars(digits, digits + sizeof digits, static_cast<long>(value))
              : std::to_chars(digits, digits + sizeof digits, value);
    return failed == std::errc{} ? std::string(digits, end) : "0";
}

}  // namespace farol
