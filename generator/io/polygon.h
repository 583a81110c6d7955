#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace farol::generator::io {

using FaceTriangle = std::array<std::uint32_t, 3>;

/// Makes `out` the triangles of a face, as numbers of its corners: always corners - 2, of the
/// face's own winding. Where the fan from the first corner covers the face (all convex ones), it is
/// that; else ears are clipped in the face's plane. Corners in one line, corners that repeat and
/// faces that cross themselves are triangulated as well as possible. Precondition: three corners or
/// more.
void triangulate(const std::vector<glm::vec3>& corners, std::vector<FaceTriangle>& out);

/// The same for positions in double: converts to float, relative to the first corner if the face is
/// far away for its size.
void triangulate(const std::vector<glm::dvec3>& corners, std::vector<FaceTriangle>& out);

}  // namespace farol::generator::io
