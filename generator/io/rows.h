#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/error.h"

/// Text of numbers, read once into rows: what all home-made mesh formats have in common.
namespace farol::generator::io {

struct Row {
    int line;             ///< from 1
    std::uint32_t first;  ///< its first number in NumberRows::values
    std::uint32_t count;  ///< how many numbers, at least 1
    std::uint32_t block;  ///< blank lines before it, runs counted once
};

struct NumberRows {
    std::string file;
    std::vector<double> values;
    std::vector<Row> rows;

    const double* at(const Row& row) const { return values.data() + row.first; }
    std::size_t blocks() const { return rows.empty() ? 0 : rows.back().block + 1; }
    /// Throws Error with the row's line.
    [[noreturn]] void refuse(const char* code, const Row& row, const std::string& message) const;
};

/// Coordinates beyond this have no use and would overflow when squared in float.
inline constexpr double kMaxCoordinate = 1e18;

/// Splits `bytes` into rows of numbers parted by blanks, commas or semicolons; `#` and `//` begin
/// comments. Throws Error mesh.syntax for anything else, mesh.number for NaN, Inf and numbers over
/// kMaxCoordinate, mesh.empty where there is no number. `bytes` begin at that line and column of
/// the file.
NumberRows parseRows(std::string_view bytes, const std::string& file, int line = 1, int column = 1);

/// A number of the file as an index below `size`. Throws mesh.index with the row's line.
std::uint32_t indexIn(const NumberRows& rows, const Row& row, double value, std::size_t size);

/// True for a whole number of at least 0.
bool isCount(double value);

}  // namespace farol::generator::io
