#include "render/plan/shadow_cut.h"

#include <cmath>
#include <vector>

namespace farol::render {
namespace {

/// Reach beyond the map's middle, in its extents, from which a mesh is cut; and where.
constexpr double kReach = 64.0, kKept = 1.0;
constexpr std::size_t kMaxCutTriangles = 20'000;

using Polygon = std::vector<glm::dvec3>;

/// The part of a polygon where `sign` times the coordinate is no more than `most`.
Polygon cut(const Polygon& polygon, int axis, double sign, double most) {
    Polygon out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const double fromA = most - sign * a[axis], fromB = most - sign * b[axis];
        if (fromA >= 0.0) out.push_back(a);
        if ((fromA >= 0.0) != (fromB >= 0.0))
            out.push_back(a + (b - a) * (fromA / (fromA - fromB)));
    }
    return out;
}

bool reachesFar(const Box& box, const glm::dmat4& lightFromObject, const glm::dvec2& middle,
                double extent) {
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                                i & 4 ? box.max.z : box.min.z);
        const glm::dvec2 at(lightFromObject * glm::dvec4(corner, 1.0));
        if (glm::length(at - middle) > kReach * extent) return true;
    }
    return false;
}

}  // namespace

std::shared_ptr<const MeshData> cutToMap(const MeshData& data, const glm::dmat4& lightFromObject,
                                         const LightView& light) {
    const glm::dvec2 middle = 0.5 * (light.min + light.max), size = light.max - light.min;
    const double extent = std::max(size.x, size.y);
    if (light.isPerspective || data.mesh.triangles() > kMaxCutTriangles ||
        !reachesFar(data.bounds, lightFromObject, middle, extent))
        return nullptr;
    std::vector<glm::dvec3> places;
    for (const glm::vec3& position : data.mesh.positions())
        places.emplace_back(lightFromObject * glm::dvec4(position, 1.0));
    for (const glm::dvec3& place : places)
        if (!(std::abs(place.z) < generator::kMaxCoordinate)) return nullptr;
    generator::MeshArrays arrays;
    const std::vector<std::uint32_t>& indices = data.mesh.indices();
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        Polygon polygon{places[indices[i]], places[indices[i + 1]], places[indices[i + 2]]};
        for (int axis = 0; axis < 2; ++axis)
            for (const double sign : {-1.0, 1.0})
                polygon = cut(polygon, axis, sign, sign * middle[axis] + kKept * extent);
        const auto first = static_cast<std::uint32_t>(arrays.positions.size());
        for (const glm::dvec3& place : polygon) arrays.positions.emplace_back(place);
        for (std::uint32_t k = 2; k < polygon.size(); ++k)
            arrays.indices.insert(arrays.indices.end(), {first, first + k - 1, first + k});
    }
    auto out = std::make_shared<MeshData>();
    out->id = nextMeshId();
    for (const glm::vec3& position : arrays.positions) out->bounds.add(glm::dvec3(position));
    out->mesh = generator::Mesh(std::move(arrays));
    return out;
}

}  // namespace farol::render
