#pragma once

#include <array>
#include <glm/glm.hpp>

namespace farol::generator {

/// A bicubic Bezier patch: control[4 * row + column]; u runs along the columns, v along the rows.
using BezierPatch = std::array<glm::dvec3, 16>;

struct PatchPoint {
    glm::dvec3 position;
    glm::dvec3 normal;  ///< unit length; +Y where the patch is a single point
};

/// The surface at column/columns and row/rows. On an edge only that edge's control points count,
/// and the sum is the same from either end: neighbours meet bit for bit. Where the first
/// derivatives do not span a plane (a collapsed edge), the normal is its limit from inside.
PatchPoint evaluate(const BezierPatch& patch, std::size_t column, std::size_t row,
                    std::size_t columns, std::size_t rows);

/// The position of that point alone, the same bits.
glm::dvec3 positionAt(const BezierPatch& patch, std::size_t column, std::size_t row,
                      std::size_t columns, std::size_t rows);

/// First and second derivatives of the surface by its parameters.
struct PatchBend {
    glm::dvec3 u, v, uu, uv, vv;
};

/// Returns the derivatives at column/columns and row/rows.
PatchBend bendAt(const BezierPatch& patch, std::size_t column, std::size_t row, std::size_t columns,
                 std::size_t rows);

}  // namespace farol::generator
