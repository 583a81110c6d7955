#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

#include "generator/mesh.h"

/// Helpers of all shapes: values are computed in double and stored as float.
namespace farol::generator {

struct SinCos {
    double sin, cos;
};

/// Sine and cosine of the fraction index/count of a full turn: exact at quarter turns, the same
/// bits at index 0 and count, and symmetric, so that seams meet and opposite points cancel.
inline SinCos turn(std::size_t index, std::size_t count) {
    constexpr double kQuarterTurn = 1.57079632679489661923;
    const std::size_t scaled = 4 * (index % count);
    const std::size_t quarter = scaled / count;
    const std::size_t rest = scaled % count;
    const double n = static_cast<double>(count);
    // Angles over an eighth of a turn are computed from the other end: sin(x) = cos(90 deg - x).
    const bool far = 2 * rest > count;
    const double angle = kQuarterTurn * (static_cast<double>(far ? count - rest : rest) / n);
    const double s = far ? std::cos(angle) : std::sin(angle);
    const double c = far ? std::sin(angle) : std::cos(angle);
    switch (quarter) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

/// index/count as a fraction, exact at both ends.
inline double fraction(std::size_t index, std::size_t count) {
    return static_cast<double>(index) / static_cast<double>(count);
}

class Builder {
  public:
    /// Reserves memory. Throws Error limit.triangles over the bounds of a mesh.
    explicit Builder(std::size_t vertices = 0, std::size_t triangles = 0) {
        checkCounts(vertices, triangles);
        mesh_.positions.reserve(vertices);
        mesh_.normals.reserve(vertices);
        mesh_.uvs.reserve(vertices);
        mesh_.indices.reserve(3 * triangles);
    }

    /// Adds a vertex; the normal need not have unit length (but must not be zero).
    std::uint32_t vertex(const glm::dvec3& position, const glm::dvec3& normal,
                         const glm::dvec2& uv) {
        // Adding zero turns -0 into +0: equal positions then have equal bits.
        mesh_.positions.push_back(glm::vec3(position) + 0.0F);
        mesh_.normals.push_back(glm::vec3(glm::normalize(normal)) + 0.0F);
        mesh_.uvs.emplace_back(uv);
        return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
    }

    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        mesh_.indices.insert(mesh_.indices.end(), {a, b, c});
    }

    /// The same, unless two corners have one position (a collapsed edge).
    void triangleUnlessFlat(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto& p = mesh_.positions;
        if (p[a] != p[b] && p[b] != p[c] && p[c] != p[a]) triangle(a, b, c);
    }

    /// The offset subtracted from all positions: Mesh::origin().
    void origin(const glm::dvec3& place) { mesh_.origin = place; }

    std::uint32_t next() const { return static_cast<std::uint32_t>(mesh_.positions.size()); }
    /// The mesh, checked.
    Mesh take() { return Mesh(std::move(mesh_)); }

  private:
    MeshArrays mesh_;
};

}  // namespace farol::generator
