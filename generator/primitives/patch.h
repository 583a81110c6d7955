#pragma once

#include "generator/entry.h"
#include "generator/io/patch_file.h"

namespace farol::generator::primitives {

/// Bicubic Bezier patches of level x level quads each, split from (row i, column j+1) to
/// (row i+1, column j); s = 1 - column/level, t = 1 - row/level; the normal is (d/d column) x
/// (d/d row), which points out of the classic teapot. Triangles folded by a collapsed edge are
/// left out.
Mesh patch(const io::PatchFile& file, std::size_t level);

/// The mesh of patches that errs by at most fineness.error, to both sides: each class of edges has
/// its level (PatchLevels, added to `divisions`), and vertices stand out of the surface by half of
/// what their facets fall short of it. The error is measured at the middles of all edges of the
/// mesh. Meshes of over half a million triangles keep their vertices in the surface, and have their
/// levels by the bends of the surface alone. Throws Error limit.triangles.
Mesh adaptedPatch(const io::PatchFile& file, const Fineness& fineness,
                  std::vector<std::size_t>& divisions);

/// The triangles of `patch`'s mesh, or more where points fold without a whole edge collapsing.
std::size_t patchTriangles(const io::PatchFile& file, std::size_t level);

/// Divisions where none are asked for.
inline constexpr std::size_t kDefaultPatchLevel = 10;

ShapeEntry patchEntry();

}  // namespace farol::generator::primitives
