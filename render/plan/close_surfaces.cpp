#include "render/plan/close_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace farol::render {
namespace {

/// Size of the pieces of a triangle that are near, and by which a coarse mesh may stand off its
/// surface: shares of a surface's size.
constexpr double kPiece = 0.02;
/// Triangles of a mesh that is examined; larger meshes are drawn unchanged.
constexpr std::size_t kMaxLookedAt = 4096;
constexpr int kMaxPieceDepth = 50;  ///< of a triangle's division in four

/// An instance in view, by its box along the world's axes.
struct Body {
    std::size_t instance;
    glm::dvec3 center, half;
    bool isSurface;

    bool overlaps(const Body& other, double margin) const {
        const glm::dvec3 apart = glm::abs(center - other.center) - half - other.half;
        return std::max({apart.x, apart.y, apart.z}) <= margin;
    }
};

bool hasRay(const InstanceList& list, const Instance& instance) {
    if (!instance.open || instance.surface < 0) return false;
    const generator::SurfaceKind& kind =
        *list.surfaces[static_cast<std::size_t>(instance.surface)].kind;
    return kind.raySteps > 0 && kind.distance != nullptr;
}

Body bodyOf(const InstanceList& list, std::size_t index) {
    const Instance& instance = list.instances[index];
    const Box& box = instance.mesh->bounds;
    const glm::dvec3 half = (box.max - box.min) * 0.5;
    Body body{index,
              glm::dvec3(instance.worldFromObject * glm::dvec4((box.min + box.max) * 0.5, 1.0)),
              glm::dvec3(0.0), hasRay(list, instance)};
    for (int i = 0; i < 3; ++i)
        body.half += glm::abs(glm::dvec3(instance.worldFromObject[i])) * half[i];
    return body;
}

using Piece = std::array<glm::dvec3, 3>;

/// The surface of one instance, and other meshes in its units.
class Nearness {
  public:
    /// Nothing for a flattened surface.
    static std::optional<Nearness> of(const InstanceList& list, const Instance& instance) {
        Nearness out(list.surfaces[static_cast<std::size_t>(instance.surface)]);
        glm::dmat3 worldFromUnit(instance.worldFromObject);
        double smallest = 1e300, largest = 0.0;
        for (int i = 0; i < 3; ++i) {
            worldFromUnit[i] *= out.surface_.lengths[i];
            const double length = glm::length(worldFromUnit[i]);
            smallest = std::min(smallest, length);
            largest = std::max(largest, length);
        }
        out.isStretched_ = largest > 1.5 * smallest;
        const glm::dmat3 inverse = glm::inverse(worldFromUnit);
        for (int i = 0; i < 3; ++i)
            if (!(glm::length(inverse[i]) < 1e300)) return std::nullopt;
        out.unitFromWorld_ = inverse;
        out.origin_ = glm::dvec3(instance.worldFromObject[3]);
        out.unitsPerWorld_ = 1.0 / smallest;
        return out;
    }

    /// True where the other one comes within `margin`, world units, or kPiece.
    bool meets(const Instance& other, double margin) {
        const generator::Mesh& mesh = other.mesh->mesh;
        margin_ = margin * unitsPerWorld_;
        unitFromObject_ = unitFromWorld_ * glm::dmat3(other.worldFromObject);
        offset_ = unitFromWorld_ * (glm::dvec3(other.worldFromObject[3]) - origin_);
        const Box& box = other.mesh->bounds;
        const glm::dvec3 half = (box.max - box.min) * 0.5;
        double radius = 0.0;
        for (int corner = 0; corner < 4; ++corner)
            radius = std::max(radius, glm::length(unitFromObject_ *
                                                  (half * glm::dvec3(1.0, corner & 1 ? 1.0 : -1.0,
                                                                     corner & 2 ? 1.0 : -1.0))));
        // A coarse mesh of an open shape stands off what it stands for.
        if (other.open) margin_ += kPiece * std::min(1.0, radius);
        if (distance(toUnit((box.min + box.max) * 0.5)) > radius + margin_) return false;
        if (mesh.triangles() > kMaxLookedAt) return false;
        const std::vector<std::uint32_t>& indices = mesh.indices();
        units_.clear();
        for (const glm::vec3& position : mesh.positions())
            units_.push_back(toUnit(glm::dvec3(position)));
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
            if (isNear({units_[indices[i]], units_[indices[i + 1]], units_[indices[i + 2]]}, 0))
                return true;
        return false;
    }

  private:
    explicit Nearness(const generator::Surface& surface) : surface_(surface) {}

    glm::dvec3 toUnit(const glm::dvec3& object) const { return unitFromObject_ * object + offset_; }
    double distance(const glm::dvec3& unit) const {
        return surface_.kind->distance(surface_, unit);
    }

    /// False where a piece that is near leaves the surface at more than about 30 degrees: the
    /// meshes' errors move such a crossing by hardly more than themselves. Measured by how far
    /// steps along its normal lead away. Where the surface is stretched, angles are not known.
    bool isShallow(const Piece& piece, const glm::dvec3& middle) const {
        constexpr double kStep = 0.2, kCosine = 0.75;
        if (isStretched_) return true;
        const glm::dvec3 normal = glm::cross(piece[1] - piece[0], piece[2] - piece[0]);
        const double length = glm::length(normal);
        if (!(length > 0.0)) return false;
        const glm::dvec3 step = normal * (kStep / length);
        return std::max(distance(middle + step), distance(middle - step)) >= kCosine * kStep;
    }

    bool isNear(const Piece& triangle, int depth) const {
        const glm::dvec3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
        double radius = 0.0;
        for (const glm::dvec3& corner : triangle)
            radius = std::max(radius, glm::length(corner - middle));
        if (distance(middle) > radius + margin_) return false;
        if (radius <= std::max(kPiece, margin_) || depth == kMaxPieceDepth)
            return isShallow(triangle, middle);
        const glm::dvec3 ab = (triangle[0] + triangle[1]) * 0.5,
                         bc = (triangle[1] + triangle[2]) * 0.5,
                         ca = (triangle[2] + triangle[0]) * 0.5;
        return isNear({ab, bc, ca}, depth + 1) || isNear({triangle[0], ab, ca}, depth + 1) ||
               isNear({ab, triangle[1], bc}, depth + 1) || isNear({ca, bc, triangle[2]}, depth + 1);
    }

    const generator::Surface& surface_;
    glm::dmat3 unitFromWorld_{1.0}, unitFromObject_{1.0};
    glm::dvec3 origin_{0.0}, offset_{0.0};
    double unitsPerWorld_ = 1.0, margin_ = 0.0;
    bool isStretched_ = false;
    std::vector<glm::dvec3> units_;
};

}  // namespace

std::vector<bool> needExactDepth(const InstanceList& list, const std::vector<Frustum::Side>& sides,
                                 const ViewTransform& view, double errorPx) {
    if (list.surfaces.empty()) return {};
    std::vector<Body> bodies;
    std::size_t surfaces = 0;
    for (std::size_t i = 0; i < list.instances.size(); ++i) {
        if (sides[i] == Frustum::Side::outside || list.instances[i].mesh->bounds.empty()) continue;
        bodies.push_back(bodyOf(list, i));
        surfaces += bodies.back().isSurface ? 1 : 0;
    }
    if (surfaces == 0 || surfaces > kMaxExactSurfaces || bodies.size() < 2) return {};
    std::sort(bodies.begin(), bodies.end(), [](const Body& a, const Body& b) {
        const double first = a.center.x - a.half.x, second = b.center.x - b.half.x;
        return first != second ? first < second : a.instance < b.instance;
    });
    std::vector<bool> needed(list.instances.size(), false);
    std::size_t pairs = 0;
    const auto look = [&](const Body& a, const Body& b) {
        if (!a.isSurface || (needed[a.instance] && (!b.isSurface || needed[b.instance]))) return;
        // As far as either mesh may be off at the farther end of the surface.
        const double farthest = glm::length(view.eyeFromWorld(a.center)) + glm::length(a.half);
        const double margin = 2.0 * errorPx * view.pixelAngle * farthest;
        if (!a.overlaps(b, margin)) return;
        std::optional<Nearness> nearness = Nearness::of(list, list.instances[a.instance]);
        if (!nearness || !nearness->meets(list.instances[b.instance], margin)) return;
        needed[a.instance] = true;
        if (b.isSurface) needed[b.instance] = true;
    };
    for (std::size_t i = 0; i < bodies.size(); ++i)
        for (std::size_t j = i + 1; j < bodies.size(); ++j) {
            const Body &a = bodies[i], &b = bodies[j];
            // Errors are small beside a body: only its neighbours by x can be near.
            if (b.center.x - b.half.x > a.center.x + a.half.x + 0.1 * (a.half.x + b.half.x)) break;
            if (++pairs > kMaxExactPairs) return {};
            look(a, b);
            look(b, a);
        }
    if (std::find(needed.begin(), needed.end(), true) == needed.end()) return {};
    return needed;
}

}  // namespace farol::render
