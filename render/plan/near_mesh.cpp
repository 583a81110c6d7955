#include "render/plan/near_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace farol::render {
namespace {

using glm::dvec2;
using glm::dvec3;

// Error of a vertex in float arithmetic, view space. With u = 2^-24, M = |L p| + |t| for a
// vertex p, its matrix L and its translation t: rounding the entries, the products and their sums
// is at most 5 u M; the projection adds as little relative to |v| <= M, and clipping an edge a
// rounding of its farther end. The signs of eight such errors differ: half of their sum is the
// largest error in a sweep of random views (tests/numerics). Seen at depth w that is
//     4 u M / w * f (1 + tan)   px,
// f the focal length in px, tan that of half the field of view: an error of w moves a point by its
// distance from the axis.
constexpr double kRoundings = 4.0 / (1 << 24);

// Triangles are clipped at planes outside the view: the clipped edges are never visible.
constexpr double kWider = 1.5;
/// Distances to the corners, in those to the near plane, beyond which double cannot cut in one go.
constexpr double kBlurred = 1e12;
/// Ratio of the depths within a piece: interpolation loses as many digits over a triangle.
constexpr double kBand = 16.0;

/// Distances to the sides of the view at which triangles are cut, inward; view space.
struct Sides {
    dvec2 tangents;
    double near, far;

    explicit Sides(const ViewTransform& view)
        : tangents(view.tanHalfFov * kWider), near(view.near * 0.5), far(view.far * 2.0) {}
    static constexpr int kCount = 6;
    double distance(int side, const dvec3& at) const {
        const double depth = -at.z;
        switch (side) {
            case 0:
                return depth - near;
            case 1:
                return far - depth;
            case 2:
                return tangents.x * depth - at.x;
            case 3:
                return tangents.x * depth + at.x;
            case 4:
                return tangents.y * depth - at.y;
            default:
                return tangents.y * depth + at.y;
        }
    }
    unsigned outside(const dvec3& at) const {
        unsigned bits = 0;
        for (int side = 0; side < kCount; ++side)
            if (distance(side, at) < 0.0) bits |= 1U << side;
        return bits;
    }
};

struct Corner {
    dvec3 position{0.0};  ///< relative to the eye, object space
    dvec3 view{0.0};
    dvec3 normal{0.0};
    dvec2 uv{0.0};
    glm::dvec4 color{0.0};
    dvec3 share{0.0};           ///< barycentric, of the whole triangle
    std::uint32_t index = ~0U;  ///< of the mesh; none where an edge was cut
};
using Polygon = std::vector<Corner>;

class Placer {
  public:
    /// `fromEye`: of the mesh's vertices, or null: their positions less the viewer's.
    Placer(const MeshData& data, const MeshPlace& place, const ViewTransform& view,
           const std::vector<dvec3>* fromEye = nullptr)
        : data_(data),
          fromEye_(fromEye),
          mesh_(data.mesh),
          place_(place),
          view_(view),
          sides_(view),
          linear_(place.worldFromObject),
          eye_(eyeOf(place, view)) {
        // Zero but where the object is flattened.
        rest_ = view.rotation * (linear_ * eye_ + (dvec3(place.worldFromObject[3]) - view.eye));
        const double widest = std::max(view.tanHalfFov.x, view.tanHalfFov.y);
        pxFromError_ = kRoundings * (1.0 + widest) / view.pixelAngle;
        away_ = glm::length(dvec3(place.worldFromObject[3]) - view.eye);
    }

    /// False where floats hold every vertex of the bounds, seen from their nearest place.
    bool isSuspect() const {
        const Box& box = data_.bounds;
        constexpr double kMost = 0.1 * generator::kMaxCoordinate;
        if (box.empty() || !(glm::length(eye_) < kMost)) return false;
        const dvec3 farthest = glm::max(glm::abs(box.min), glm::abs(box.max));
        double reach = away_;
        for (int k = 0; k < 3; ++k) reach += glm::length(linear_[k]) * farthest[k];
        return reach * pxFromError_ > kFloatErrorPx * nearest(box);
    }

    /// True where floats move one of the triangles by too much.
    bool isNeeded() {
        placeVertices();
        const std::vector<std::uint32_t>& indices = mesh_.indices();
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            const std::uint32_t* corner = &indices[i];
            const unsigned a = outside_[corner[0]], b = outside_[corner[1]],
                           c = outside_[corner[2]];
            if (a & b & c) continue;
            double reach = 0.0;
            for (int k = 0; k < 3; ++k) reach = std::max(reach, reachOf(corner[k]));
            // Most triangles pass at the nearest depth that they could be seen at.
            if (reach * pxFromError_ <= kFloatErrorPx * lowestDepth(corner)) continue;
            // So far away that a single cut in double is not exact enough.
            if (reach > kBlurred * view_.near) return true;
            double depth = HUGE_VAL;
            for (const Corner& one : inView(corner)) depth = std::min(depth, -one.view.z);
            if (reach * pxFromError_ > kFloatErrorPx * depth) return true;
        }
        return false;
    }

    std::optional<NearMesh> build(std::size_t maxVertices) {
        if (views_.empty()) placeVertices();
        used_.assign(mesh_.positions().size(), ~0U);
        std::vector<generator::MeshPart> parts = mesh_.parts();
        if (parts.empty()) parts.push_back({"", 0, mesh_.indices().size()});
        for (generator::MeshPart& part : parts) {
            const std::size_t first = partFirst_ = out_.indices.size();
            for (std::size_t i = part.first; i < part.first + part.count; i += 3) {
                addTriangle(&mesh_.indices()[i], (i - part.first) / 3);
                if (out_.positions.size() > maxVertices) return std::nullopt;
            }
            part.first = first;
            part.count = out_.indices.size() - first;
        }
        if (!mesh_.parts().empty()) out_.parts = std::move(parts);
        return take();
    }

  private:
    /// The viewer in object space; of a flattened object the place nearest to it.
    static dvec3 eyeOf(const MeshPlace& place, const ViewTransform& view) {
        const glm::dmat3 linear(place.worldFromObject);
        const dvec3 eye = view.eye - dvec3(place.worldFromObject[3]);
        const double size =
            std::max({glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])});
        const double volume = std::abs(glm::determinant(linear / size));
        if (volume > 1e-30) return glm::inverse(linear) * eye;
        glm::dmat3 square = glm::transpose(linear) * linear;
        for (int k = 0; k < 3; ++k) square[k][k] += 1e-12 * size * size;
        return glm::inverse(square) * (glm::transpose(linear) * eye);
    }

    dvec3 viewOf(const dvec3& relative) const {
        // World axes first: where they are the object's, nothing is rounded.
        return view_.rotation * (linear_ * relative) + rest_;
    }

    /// A depth in view at which a point of the box may be.
    double nearest(const Box& box) const {
        const dvec3 outside = glm::max(glm::max(box.min - eye_, eye_ - box.max), 0.0);
        double distance = 0.0;
        const glm::dmat3 rows = glm::transpose(glm::inverse(linear_));
        for (int k = 0; k < 3; ++k) {
            const double across = outside[k] / glm::length(rows[k]);
            if (std::isfinite(across)) distance = std::max(distance, across);
        }
        const double secant = std::sqrt(1.0 + glm::dot(view_.tanHalfFov, view_.tanHalfFov));
        return std::max(view_.near, distance / secant);
    }

    dvec3 fromEye(std::size_t vertex) const {
        return fromEye_ ? (*fromEye_)[vertex] : dvec3(mesh_.positions()[vertex]) - eye_;
    }

    void placeVertices() {
        const std::size_t count = mesh_.positions().size();
        views_.reserve(count);
        outside_.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            views_.push_back(viewOf(fromEye(i)));
            outside_.push_back(static_cast<std::uint8_t>(sides_.outside(views_.back())));
        }
    }

    double reachOf(std::uint32_t vertex) const {
        return away_ + glm::length(linear_ * dvec3(mesh_.positions()[vertex]));
    }

    double lowestDepth(const std::uint32_t* corner) const {
        double depth = HUGE_VAL;
        for (int k = 0; k < 3; ++k) depth = std::min(depth, -views_[corner[k]].z);
        return std::max(depth, view_.near);
    }

    Corner cornerOf(std::uint32_t index) const {
        Corner corner;
        corner.index = index;
        corner.position = fromEye(index);
        corner.view = views_[index];
        if (!mesh_.normals().empty()) corner.normal = dvec3(mesh_.normals()[index]);
        if (!mesh_.uvs().empty()) corner.uv = dvec2(mesh_.uvs()[index]);
        if (!mesh_.colors().empty()) corner.color = glm::dvec4(mesh_.colors()[index]);
        return corner;
    }

    /// Between two corners, counted from the first. The same for both triangles at an edge.
    Corner between(const Corner& from, const Corner& to, double share) const {
        Corner out;
        out.position = from.position + share * (to.position - from.position);
        out.view = viewOf(out.position);
        out.normal = from.normal + share * (to.normal - from.normal);
        out.uv = from.uv + share * (to.uv - from.uv);
        out.color = from.color + share * (to.color - from.color);
        out.share = from.share + share * (to.share - from.share);
        return out;
    }

    /// Returns the part of a polygon at a distance of 0 or more; Sutherland and Hodgman 1974.
    template <typename Distance>
    Polygon cut(const Polygon& polygon, const Distance& distance) const {
        if (std::all_of(polygon.begin(), polygon.end(),
                        [&](const Corner& one) { return distance(one.view) >= 0.0; }))
            return polygon;
        Polygon out;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
            const double fromA = distance(a.view), fromB = distance(b.view);
            if (fromA >= 0.0) out.push_back(a);
            if ((fromA >= 0.0) == (fromB >= 0.0)) continue;
            // From the nearer end, whichever side of the cut and of the edge is asked for.
            const bool isOnward = a.view.z != b.view.z ? a.view.z > b.view.z : fromA >= 0.0;
            out.push_back(isOnward ? between(a, b, fromA / (fromA - fromB))
                                   : between(b, a, fromB / (fromB - fromA)));
        }
        return out;
    }

    Polygon inView(const std::uint32_t* corner) const {
        Polygon polygon{cornerOf(corner[0]), cornerOf(corner[1]), cornerOf(corner[2])};
        const unsigned crossed = outside_[corner[0]] | outside_[corner[1]] | outside_[corner[2]];
        for (int side = 0; side < Sides::kCount && !polygon.empty(); ++side)
            if (crossed & (1U << side)) polygon = cutToSide(polygon, side);
        return polygon;
    }

    int bandOf(double depth) const {
        return static_cast<int>(std::floor(std::log(depth / sides_.near) / std::log(kBand)));
    }

    /// Adds the visible part of one triangle, the `number`-th of its part of the mesh: from far to
    /// near, in pieces of a small depth range each, with the same cuts for all triangles. A piece
    /// is cut out of a cube of its size round the viewer first: vertices err by 2^-53 of their
    /// distance, and so by no more than that share of the piece.
    void addTriangle(const std::uint32_t* corner, std::size_t number) {
        if (outside_[corner[0]] & outside_[corner[1]] & outside_[corner[2]]) return;
        Polygon polygon{cornerOf(corner[0]), cornerOf(corner[1]), cornerOf(corner[2])};
        startFace(corner, polygon);
        double low = HUGE_VAL, high = sides_.near;
        for (const Corner& one : polygon) {
            low = std::min(low, -one.view.z);
            high = std::max(high, -one.view.z);
        }
        const int last = low > sides_.near ? bandOf(low) : 0;
        for (int band = bandOf(std::min(high, sides_.far)); band >= last; --band) {
            const double nearest = sides_.near * std::pow(kBand, band);
            polygon = cutToCube(std::move(polygon), nearest * kBand);
            Polygon piece = cut(polygon, [&](const dvec3& at) { return -at.z - nearest; });
            for (int side = 1; side < Sides::kCount; ++side) piece = cutToSide(piece, side);
            addFan(piece, number);
            if (band > last)
                polygon = cut(polygon, [&](const dvec3& at) { return nearest + at.z; });
        }
    }

    Polygon cutToSide(const Polygon& polygon, int side) const {
        return cut(polygon, [&](const dvec3& at) { return sides_.distance(side, at); });
    }

    /// Returns the part of a polygon that may be in view no farther than `depth`.
    Polygon cutToCube(Polygon polygon, double depth) const {
        const double half = 2.0 * depth * (1.0 + std::max(sides_.tangents.x, sides_.tangents.y));
        for (int axis = 0; axis < 3; ++axis)
            for (const double sign : {-1.0, 1.0})
                polygon = cut(polygon, [&](const dvec3& at) { return half + sign * at[axis]; });
        return polygon;
    }

    /// Stores the data of a whole triangle that its pieces need: its normal and centre for flat
    /// shading, its corners for gouraud.
    void startFace(const std::uint32_t* corner, Polygon& polygon) {
        if (place_.isGouraud)
            for (int k = 0; k < 3; ++k) {
                Corner& one = polygon[static_cast<std::size_t>(k)];
                corners_.positions[k] = glm::vec3(one.view);
                corners_.normals[k] = glm::vec3(one.normal);
                one.share[k] = 1.0;
                one.index = ~0U;
            }
        if (!place_.isFlat) return;
        std::array<dvec3, 3> at{};
        for (std::size_t k = 0; k < 3; ++k) at[k] = fromEye(corner[k]);
        const dvec3 cross = glm::cross(at[1] - at[0], at[2] - at[0]);
        const double size = glm::length(cross);
        center_ = (at[0] + at[1] + at[2]) / 3.0;
        for (Corner& one : polygon) {
            if (size > 0.0) one.normal = cross / size;
            one.index = ~0U;
        }
    }

    void addFan(const Polygon& polygon, std::size_t number) {
        if (polygon.size() < 3) return;
        std::vector<std::uint32_t> vertices;
        for (const Corner& corner : polygon) vertices.push_back(vertexOf(corner));
        for (std::size_t i = 2; i < vertices.size(); ++i) {
            const std::uint32_t first = vertices[0];
            // A triangle without area in between keeps even ones even.
            if (place_.keepsParity && ((out_.indices.size() - partFirst_) / 3 + number) % 2 != 0)
                out_.indices.insert(out_.indices.end(), {first, first, first});
            out_.indices.insert(out_.indices.end(), {first, vertices[i - 1], vertices[i]});
        }
    }

    std::uint32_t vertexOf(const Corner& corner) {
        if (corner.index != ~0U && used_[corner.index] != ~0U) return used_[corner.index];
        const auto index = static_cast<std::uint32_t>(out_.positions.size());
        if (corner.index != ~0U) used_[corner.index] = index;
        out_.positions.emplace_back(corner.position);
        eyePositions_.emplace_back(corner.view);
        if (!mesh_.normals().empty() || place_.isFlat) out_.normals.emplace_back(corner.normal);
        if (place_.isFlat) faceCenters_.emplace_back(center_);
        if (place_.isGouraud) {
            litCorners_.push_back(corners_);
            litCorners_.back().shares = glm::vec3(corner.share);
        }
        if (!mesh_.uvs().empty()) uvs_.push_back(corner.uv);
        if (!mesh_.colors().empty()) out_.colors.emplace_back(corner.color + 0.5);
        return index;
    }

    /// Coordinates that reach far are stored relative to those nearest to the viewer.
    void settleUvs() {
        out_.uvOrigin = mesh_.uvOrigin();
        dvec2 origin(0.0);
        double nearest = HUGE_VAL, farthest = 0.0;
        for (std::size_t i = 0; i < uvs_.size(); ++i) {
            farthest = std::max({farthest, std::abs(uvs_[i].x), std::abs(uvs_[i].y)});
            const double depth = glm::length(dvec3(eyePositions_[i]));
            if (depth < nearest) {
                nearest = depth;
                origin = uvs_[i];
            }
        }
        constexpr double kFar = 32.0;
        if (place_.hasSurface || farthest <= kFar) origin = dvec2(0.0);
        out_.uvOrigin += origin;
        for (const dvec2& uv : uvs_) out_.uvs.emplace_back(uv - origin);
    }

    NearMesh take() {
        settleUvs();
        // The surface's own place is kept: its pixels add the viewer's.
        out_.origin = place_.hasSurface ? mesh_.origin() : mesh_.origin() + eye_;
        auto data = std::make_shared<MeshData>();
        data->id = nextMeshId();
        data->balance = data_.balance;
        data->fullTurn = data_.fullTurn;
        for (const glm::vec3& position : out_.positions) data->bounds.add(dvec3(position));
        data->eyePositions = std::move(eyePositions_);
        data->faceCenters = std::move(faceCenters_);
        data->litCorners = std::move(litCorners_);
        data->mesh = generator::Mesh(std::move(out_));
        return {std::move(data), eye_};
    }

    const MeshData& data_;
    const std::vector<dvec3>* const fromEye_;
    const generator::Mesh& mesh_;
    const MeshPlace& place_;
    const ViewTransform& view_;
    const Sides sides_;
    const glm::dmat3 linear_;  ///< world from object
    const dvec3 eye_;          ///< object space
    dvec3 rest_{0.0};
    double pxFromError_ = 0.0, away_ = 0.0;
    std::vector<dvec3> views_;
    std::vector<std::uint8_t> outside_;
    std::vector<std::uint32_t> used_;  ///< new indices of the mesh's own vertices
    generator::MeshArrays out_;
    std::vector<dvec2> uvs_;
    std::vector<glm::vec3> eyePositions_, faceCenters_;
    dvec3 center_{0.0};
    LitCorners corners_{};
    std::vector<LitCorners> litCorners_;
    std::size_t partFirst_ = 0;
};

}  // namespace

std::optional<NearMesh> placeInDouble(const MeshData& data, const MeshPlace& place,
                                      const ViewTransform& view, std::size_t maxVertices) {
    Placer placer(data, place, view);
    if (!placer.isSuspect() || !placer.isNeeded()) return std::nullopt;
    return placer.build(maxVertices);
}

std::optional<NearMesh> placeInDouble(ExactMesh exact, const MeshPlace& place,
                                      const ViewTransform& view, std::size_t maxVertices) {
    exact.arrays.positions.assign(exact.fromEye.size(), glm::vec3(0.0F));
    MeshData data;
    data.mesh = generator::Mesh(std::move(exact.arrays));
    return Placer(data, place, view, &exact.fromEye).build(maxVertices);
}

}  // namespace farol::render
