#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "generator/mesh.h"

/// Text of numbers, read once into rows: the common part of all home-made mesh formats.
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
    [[noreturn]] void refuse(Message message, const Row& row) const;
};

/// Splits `bytes` into rows of numbers parted by blanks, commas, semicolons or brackets; `#` and
/// `//` begin comments. "nan" of any spelling, infinities and "1.#QNAN" are NaN: the readers decide
/// whether the number matters. Throws Error mesh.syntax for anything else, mesh.number for numbers
/// over kMaxCoordinate, mesh.empty where there is no number. `bytes` begin at that line and column
/// of the file.
NumberRows parseRows(std::string_view bytes, const std::string& file, int line = 1, int column = 1);

/// A number as parseRows reads it; nothing where the token is none. Throws mesh.number.
std::optional<double> numberOf(std::string_view token, const Location& where);

/// Returns where the comment of a line begins, or npos. The # of "1.#QNAN" begins none.
std::size_t commentStart(std::string_view line, bool slashesToo = true);

/// True for blanks, commas, semicolons and brackets.
bool isSeparator(char c);
/// Where the token ends that begins at `at`.
std::size_t tokenEnd(std::string_view text, std::size_t at);

/// The three numbers from `v` on as a place. Throws mesh.number with the row's line for NaN.
glm::dvec3 placeAt(const NumberRows& rows, const Row& row, const double* v);

/// A number of the file as an index below `size`. Throws mesh.index with the row's line.
std::uint32_t indexIn(const NumberRows& rows, const Row& row, double value, std::size_t size);

/// Returns the first index of these numbers: 1 where none is 0 and the largest is `size`, else 0.
double indexBase(const double* begin, const double* end, std::size_t size);

/// True for a whole number of at least 0.
bool isCount(double value);

}  // namespace farol::generator::io
