#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "generator/registry.h"

namespace farol::generator {

/// A shape's words, read and checked: "cone 1 2 4 3" is {cone, values {1, 2, 4, 3}, given 4}.
struct Call {
    const Shape* shape = nullptr;
    std::string file;            ///< the profile or patch file, where the shape takes one
    std::vector<double> values;  ///< one an argument, in the order of `Shape::arguments`
    std::size_t given = 0;       ///< so many were written; the rest are the arguments' defaults

    double length(std::size_t index) const { return values[index]; }
    std::size_t count(std::size_t index) const { return static_cast<std::size_t>(values[index]); }
};

/// Reads words such as {"cone", "1", "2", "4", "3"}; level arguments may be left out, or be
/// "auto". Throws Error shape.unknown or shape.argument: the message names the argument and its
/// range.
Call parseCall(const std::vector<std::string>& words);

/// True for a finite number as scenes write it: "000", ".5", "+1", "1e3", "2.5f".
bool parseNumber(const std::string& word, double& value);

}  // namespace farol::generator
