#pragma once

#include <string>
#include <string_view>

namespace farol::scene {

/// Numbers beyond this are refused: their squares would not fit the GPU's floats.
inline constexpr double kHugeNumber = 1e18;

struct ParsedNumber {
    double value = 0.0;   ///< finite; numbers that a float holds only as a denormal become 0
    std::string problem;  ///< empty if it is a number, else what is wrong and how to mend it
};

/// A number as scene files write it: blanks round it, a sign, "000", ".5", "1e3", a trailing "f".
/// Locale-independent. A comma decimal, NaN, infinity and |value| > kHugeNumber are problems.
ParsedNumber parseNumber(std::string_view text);

/// The shortest text that reads back as the same double.
std::string formatNumber(double value);

}  // namespace farol::scene
