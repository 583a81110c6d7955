#pragma once

#include <string>
#include <string_view>

#include "core/error.h"
#include "generator/mesh.h"

namespace farol::generator {

/// A mesh file against the mesh that is expected of it.
struct MeshCheck {
    /// check.*, at the line of the vertex in the file. Errors are mistakes; a warning draws the
    /// same (triangles without area); an info is a difference that is accepted.
    Diagnostics findings;
    std::size_t triangles = 0, expectedTriangles = 0;
    std::size_t places = 0, expectedPlaces = 0;  ///< vertices at different places

    /// Returns whether nothing is wrong.
    bool isRight() const;
};

/// Checks positions, triangles, winding, normals and texture coordinates. Places are equal within
/// 1/2000 of the diagonal of the bounds, and a quarter of the shortest edge; normals within 3
/// degrees; coordinates within 0.002. Accepted are the order of vertices and triangles, shared
/// vertices or not, the other diagonal of a quad, divisions of a round shape that start at another
/// angle, the start of its texture's seam, whole turns of coordinates, and the direction of u at
/// its axis. The file is read as it is: nothing is repaired. Throws Error mesh.* where it cannot be
/// read.
MeshCheck checkMesh(std::string_view bytes, const std::string& fileName, const Mesh& expected);

}  // namespace farol::generator
