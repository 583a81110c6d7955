#pragma once

#include <vector>

#include "generator/bezier.h"
#include "generator/builder.h"
#include "generator/primitives/patch_levels.h"

namespace farol::generator::primitives {

/// The vertices of a patch, row by row, level.u + 1 in each.
struct PatchGrid {
    PatchLevel level;
    std::vector<PatchPoint> points;

    /// The surface's own points.
    PatchGrid(const BezierPatch& patch, PatchLevel divisions);
    std::size_t at(std::size_t row, std::size_t column) const {
        return row * (level.u + 1) + column;
    }
};

/// Adds the grid's vertices and its triangles, each cell split from (row i, column j + 1) to
/// (row i + 1, column j); s = 1 - column/level.u, t = 1 - row/level.v. Triangles folded by a
/// collapsed edge are left out.
void addGrid(Builder& builder, const PatchGrid& grid);

/// Returns grids of patches whose vertices are offset outwards by half of their facets' sagitta.
/// Refines `levels` until no middle of an edge is farther than fineness.error from the surface.
/// Vertices at the same position get the same offset. Returns nothing if that takes more than half
/// a million triangles.
std::vector<PatchGrid> fittedGrids(const std::vector<BezierPatch>& patches,
                                   const Fineness& fineness, PatchLevels& levels);

}  // namespace farol::generator::primitives
