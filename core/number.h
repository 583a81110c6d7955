#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <optional>
#include <string>
#include <string_view>

#include "core/message.h"

namespace farol {

/// Numbers beyond this are refused: their squares would not fit the GPU's floats.
inline constexpr double kHugeNumber = 1e18;

struct ParsedNumber {
    double value = 0.0;  ///< finite; numbers that a float holds only as a denormal become 0
    Message problem;     ///< empty for a number; else a part.number-* with the problem and the fix
};

/// A number as scene files write it: blanks round it, a sign, "000", ".5", "1e3", a trailing "f".
/// Locale-independent. A comma decimal, NaN, infinity and |value| > kHugeNumber are problems.
ParsedNumber parseNumber(std::string_view text);

/// The number that the whole text is, as protocols and files of our own write it: no blanks, no
/// plus sign, a minus sign for signed types alone, in decimal; nothing else is a number, nor is
/// a value beyond the range of `Number`, infinity or NaN. Locale-independent.
template <typename Number>
std::optional<Number> parseExact(std::string_view text) {
    Number value{};
    const char* const end = text.data() + text.size();
    const auto [stop, failed] = std::from_chars(text.data(), end, value);
    if (failed != std::errc{} || stop != end) return std::nullopt;
    if constexpr (std::floating_point<Number>)
        if (!std::isfinite(value)) return std::nullopt;
    return value;
}

/// The shortest text that reads back as the same double.
std::string formatNumber(double value);

}  // namespace farol
