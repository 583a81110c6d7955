#pragma once

#include "generator/entry.h"
#include "generator/io/patch_file.h"

namespace farol::generator::primitives {

/// Bicubic Bezier patches of level x level quads each, split from (row i, column j+1) to
/// (row i+1, column j); s = 1 - column/level, t = 1 - row/level; the normal is (d/d column) x
/// (d/d row), which points out of the classic teapot. Triangles folded by a collapsed edge are
/// left out.
Mesh patch(const io::PatchFile& file, std::size_t level);

/// Returns a mesh of the patches within fineness.error of the surface, to both sides. Each class of
/// edges has its level (PatchLevels, returned in `divisions`); vertices are offset outwards by half
/// of their facets' sagitta. The error is measured at the middles of all edges of the mesh. In
/// meshes of over half a million triangles the vertices stay in the surface, and its curvature
/// alone sets the levels. Throws Error limit.triangles.
Mesh adaptedPatch(const io::PatchFile& file, const Fineness& fineness,
                  std::vector<std::size_t>& divisions);

/// The triangles of `patch`'s mesh, or more where points fold without a whole edge collapsing.
std::size_t patchTriangles(const io::PatchFile& file, std::size_t level);

/// Divisions where none are asked for.
inline constexpr std::size_t kDefaultPatchLevel = 10;

ShapeEntry patchEntry();

}  // namespace farol::generator::primitives
