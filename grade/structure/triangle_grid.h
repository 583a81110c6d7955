#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "generator/mesh.h"
#include "grade/structure/surface.h"

namespace farol::grade {

/// Interpolated attributes at a point of a triangle.
struct SurfacePoint {
    glm::dvec3 normal{0.0};
    glm::vec2 uv{0.0F};
};

/// Triangles in a regular grid, to find those near a point.
class TriangleGrid {
  public:
    TriangleGrid(const generator::Mesh& mesh, const glm::dmat4& matrix);

    /// Calls `each` with the nearest point of every triangle within `reach` of the place, for 16
    /// triangles at most. Returns whether there is one.
    bool near(const glm::dvec3& place, double reach,
              const std::function<void(const SurfacePoint&)>& each) const;

  private:
    std::size_t cellOf(const glm::ivec3& at) const;
    glm::ivec3 gridPlace(const glm::dvec3& place) const;

    static constexpr int kSide = 24;  ///< cells along each axis
    struct Triangle {
        std::array<glm::dvec3, 3> corners;
        std::array<std::uint32_t, 3> index;
    };
    std::vector<Triangle> triangles_;
    std::vector<glm::dvec3> normals_;
    std::vector<glm::vec2> uvs_;
    std::vector<std::vector<std::uint32_t>> cells_;
    glm::dvec3 low_{0.0}, cell_{1.0};
};

struct KnownMesh::Grid {
    TriangleGrid triangles;
};

}  // namespace farol::grade
