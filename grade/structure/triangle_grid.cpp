#include "grade/structure/triangle_grid.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "generator/registry.h"

namespace farol::grade {
namespace {

/// The barycentric coordinates of the triangle's point nearest to p (Ericson, Real-Time Collision
/// Detection, 5.1.5).
glm::dvec3 nearestOf(const std::array<glm::dvec3, 3>& t, const glm::dvec3& p) {
    const glm::dvec3 ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0) return {1, 0, 0};
    const glm::dvec3 bp = p - t[1];
    const double d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3) return {0, 1, 0};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        const double v = d1 - d3 > 0.0 ? d1 / (d1 - d3) : 0.0;
        return {1 - v, v, 0};
    }
    const glm::dvec3 cp = p - t[2];
    const double d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6) return {0, 0, 1};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        const double w = d2 - d6 > 0.0 ? d2 / (d2 - d6) : 0.0;
        return {1 - w, 0, w};
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double sum = (d4 - d3) + (d5 - d6);
        const double w = sum > 0.0 ? (d4 - d3) / sum : 0.0;
        return {0, 1 - w, w};
    }
    const double sum = va + vb + vc;
    if (!(sum > 0.0)) return {1, 0, 0};
    return {va / sum, vb / sum, vc / sum};
}

constexpr double kFineDivisions = 96;  // of a full turn: facets within 0.05 % of the radius
constexpr double kMinDivisions = 8;    // a shape with fewer has visible edges on purpose

/// Returns the model's mesh; that of a curved shape with fine divisions.
generator::Mesh fineMesh(const scene::Model& model, const generator::Mesh& mesh,
                         const scene::Assets& assets) {
    const scene::ShapeCall& call = model.source.shape;
    if (model.source.kind != scene::ModelSource::Kind::shape || call.entry == nullptr ||
        call.entry->surface == nullptr)
        return mesh;
    scene::ShapeCall fine = call;
    for (std::size_t i = 0; i < fine.arguments.size(); ++i) {
        if (!fine.entry->arguments[i].isLevel()) continue;
        // Its first level goes round; a cone of four slices is a pyramid.
        if (fine.arguments[i].value < kMinDivisions &&
            (i == 0 || !fine.entry->arguments[i - 1].isLevel()))
            return mesh;
        fine.arguments[i] = {scene::ShapeArgument::Form::written,
                             std::max(fine.arguments[i].value, kFineDivisions)};
    }
    return generator::generate(fine, assets, model.uv);
}

}  // namespace

TriangleGrid::TriangleGrid(const generator::Mesh& mesh, const glm::dmat4& matrix) {
    glm::dvec3 high(-1e300);
    low_ = glm::dvec3(1e300);
    std::vector<glm::dvec3> places;
    places.reserve(mesh.positions().size());
    for (const glm::vec3& position : mesh.positions()) {
        places.push_back(glm::dvec3(matrix * glm::dvec4(position, 1.0)));
        low_ = glm::min(low_, places.back());
        high = glm::max(high, places.back());
    }
    for (const glm::vec3& normal : mesh.normals()) normals_.emplace_back(normal);
    uvs_ = mesh.uvs();
    if (places.empty()) low_ = high = glm::dvec3(0.0);
    const double least = std::max(1e-9, glm::length(high - low_) * 1e-3);
    cell_ = glm::max(high - low_, glm::dvec3(least)) / static_cast<double>(kSide);
    cells_.resize(static_cast<std::size_t>(kSide * kSide * kSide));
    for (std::size_t t = 0; t + 2 < mesh.indices().size(); t += 3) {
        const std::array<std::uint32_t, 3> index{mesh.indices()[t], mesh.indices()[t + 1],
                                                 mesh.indices()[t + 2]};
        const std::array<glm::dvec3, 3> corners{places[index[0]], places[index[1]],
                                                places[index[2]]};
        const glm::ivec3 from = gridPlace(glm::min(glm::min(corners[0], corners[1]), corners[2]));
        const glm::ivec3 to = gridPlace(glm::max(glm::max(corners[0], corners[1]), corners[2]));
        const auto number = static_cast<std::uint32_t>(triangles_.size());
        triangles_.push_back({corners, index});
        for (int x = from.x; x <= to.x; ++x)
            for (int y = from.y; y <= to.y; ++y)
                for (int z = from.z; z <= to.z; ++z) cells_[cellOf({x, y, z})].push_back(number);
    }
}

std::size_t TriangleGrid::cellOf(const glm::ivec3& at) const {
    return static_cast<std::size_t>((at.x * kSide + at.y) * kSide + at.z);
}

glm::ivec3 TriangleGrid::gridPlace(const glm::dvec3& place) const {
    const glm::dvec3 at = (place - low_) / cell_;
    glm::ivec3 out(0);
    for (int axis = 0; axis < 3; ++axis)
        out[axis] = static_cast<int>(std::clamp(at[axis], 0.0, kSide - 1.0));
    return out;
}

bool TriangleGrid::near(const glm::dvec3& place, double reach,
                        const std::function<void(const SurfacePoint&)>& each) const {
    constexpr int kMaxMet = 16;
    const glm::ivec3 from = gridPlace(place - glm::dvec3(reach)),
                     to = gridPlace(place + glm::dvec3(reach));
    int met = 0;
    for (int x = from.x; x <= to.x; ++x)
        for (int y = from.y; y <= to.y; ++y)
            for (int z = from.z; z <= to.z; ++z)
                for (const std::uint32_t number : cells_[cellOf({x, y, z})]) {
                    const Triangle& one = triangles_[number];
                    const glm::dvec3 at = nearestOf(one.corners, place);
                    const glm::dvec3 there =
                        at.x * one.corners[0] + at.y * one.corners[1] + at.z * one.corners[2];
                    if (glm::length(there - place) > reach) continue;
                    SurfacePoint point;
                    for (int k = 0; k < 3; ++k) {
                        const std::size_t corner = one.index[static_cast<std::size_t>(k)];
                        if (!normals_.empty()) point.normal += at[k] * normals_[corner];
                        if (!uvs_.empty()) point.uv += static_cast<float>(at[k]) * uvs_[corner];
                    }
                    each(point);
                    if (++met == kMaxMet) return true;
                }
    return met > 0;
}

KnownMesh::KnownMesh(const scene::Model& model, const generator::Mesh& mesh,
                     const scene::Assets& assets)
    : mesh_(&mesh), grid_(new Grid{TriangleGrid(fineMesh(model, mesh, assets), glm::dmat4(1.0))}) {}
KnownMesh::~KnownMesh() = default;
KnownMesh::KnownMesh(KnownMesh&&) noexcept = default;
KnownMesh& KnownMesh::operator=(KnownMesh&&) noexcept = default;

}  // namespace farol::grade
