#pragma once

#include <optional>
#include <string_view>

#include "generator/io/raw_mesh.h"
#include "generator/io/rows.h"

/// Readings of numbers that no form of the table has: counts and lists in other orders and units.
/// Each is tried by its exact length first, then by what its lists must be: indices whole and in
/// range, normals of unit length. They are asked only where the form that a file looks like fails.
namespace farol::generator::io {

/// Rows of text by a layout of lists, or triangles of 15 or 18 numbers a row; nothing where none
/// fits.
std::optional<RawMesh> guessLayout(const NumberRows& rows);

/// Little-endian 32-bit floats and counts (of 32 or 64 bits) by a layout of lists; nothing where
/// none fits.
std::optional<RawMesh> guessBinaryLayout(std::string_view bytes, const std::string& fileName);

}  // namespace farol::generator::io
