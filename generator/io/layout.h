#pragma once

#include <optional>
#include <string_view>

#include "generator/io/raw_mesh.h"
#include "generator/io/rows.h"

/// Reads numbers in layouts outside the table of formats: counts and lists in other orders and
/// units. Tries a layout by its exact length first, then checks its lists: indices whole and in
/// range, normals of unit length. Used only where the format that a file looks like fails.
namespace farol::generator::io {

/// Rows of text by a layout of lists, or triangles of 15 or 18 numbers a row; nothing where none
/// fits.
std::optional<RawMesh> guessLayout(const NumberRows& rows);

/// Little-endian 32-bit floats and counts (of 32 or 64 bits) by a layout of lists; nothing where
/// none fits.
std::optional<RawMesh> guessBinaryLayout(std::string_view bytes, const std::string& fileName);

}  // namespace farol::generator::io
