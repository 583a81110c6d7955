#pragma once

#include "generator/entry.h"
#include "generator/io/patch_file.h"

namespace farol::generator::primitives {

/// Bicubic Bezier patches of level x level quads each, split from (row i, column j+1) to
/// (row i+1, column j); s = 1 - column/level, t = 1 - row/level; the normal is (d/d column) x
/// (d/d row), which points out of the classic teapot. Triangles folded by a collapsed edge are
/// left out.
Mesh patch(const io::PatchFile& file, std::size_t level);

/// The triangles of that mesh, or more where points fold without a whole edge collapsing.
std::size_t patchTriangles(const io::PatchFile& file, std::size_t level);

/// Divisions where none are asked for.
inline constexpr std::size_t kDefaultPatchLevel = 10;

ShapeEntry patchEntry();

}  // namespace farol::generator::primitives
