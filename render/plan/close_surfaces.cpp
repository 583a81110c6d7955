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
/// Pieces of at most this size, units, and more than half of it are left out where they are steep.
constexpr double kAnglesLookedAt = 0.2;
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

/// From a box's middle to four of its corners; the others are opposite.
std::array<glm::dvec3, 4> armsOf(const Box& box) {
    const glm::dvec3 half = (box.max - box.min) * 0.5;
    return {half, half * glm::dvec3(1.0, -1.0, 1.0), half * glm::dvec3(1.0, 1.0, -1.0),
            half * glm::dvec3(1.0, -1.0, -1.0)};
}

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

/// To so many digits that a part's place in a whole stays the same while the whole turns.
double rounded(double value, double largest) {
    const double step = std::ldexp(1.0, std::ilogb(largest) - 30);
    return std::round(value / step) * step;
}

/// False if a value is not finite.
template <std::size_t N>
bool round(std::array<double, N>& values) {
    double largest = 1e-30;
    for (const double value : values) {
        if (!std::isfinite(value)) return false;
        largest = std::max(largest, std::abs(value));
    }
    for (double& value : values) value = rounded(value, largest);
    return true;
}

/// The next of the steps of sqrt(2): a camera that moves changes few pairs.
double roundedUp(double margin) {
    return margin > 0.0 ? std::exp2(std::ceil(std::log2(margin) * 2.0) / 2.0) : 0.0;
}

/// `margin`: world units. Nothing for a flattened surface, or one too far for numbers.
std::optional<ClosePair> pairOf(const InstanceList& list, const Instance& surfaceOf,
                                const Instance& other, double margin) {
    const generator::Surface& surface = list.surfaces[static_cast<std::size_t>(surfaceOf.surface)];
    glm::dmat3 worldFromUnit(surfaceOf.worldFromObject);
    double smallest = 1e300;
    for (int i = 0; i < 3; ++i) {
        worldFromUnit[i] *= surface.lengths[i];
        smallest = std::min(smallest, glm::length(worldFromUnit[i]));
    }
    const glm::dmat3 unitFromWorld = glm::inverse(worldFromUnit);
    for (int i = 0; i < 3; ++i)
        if (!(glm::length(unitFromWorld[i]) < 1e300)) return std::nullopt;
    const glm::dmat3 objects(other.worldFromObject);
    const glm::dmat3 linear = unitFromWorld * objects;
    const glm::dvec3 offset = unitFromWorld * (glm::dvec3(other.worldFromObject[3]) -
                                               glm::dvec3(surfaceOf.worldFromObject[3]));
    const glm::dmat3 across = unitFromWorld * smallest, metric = across * glm::transpose(across);
    ClosePair pair;
    pair.kind = reinterpret_cast<std::uintptr_t>(surface.kind);
    pair.form = {surface.form.x, surface.form.y};
    pair.mesh = other.mesh->id;
    for (int i = 0; i < 3; ++i) {
        pair.offset[static_cast<std::size_t>(i)] = offset[i];
        for (int j = 0; j < 3; ++j) {
            pair.linear[static_cast<std::size_t>(3 * i + j)] = linear[i][j];
            pair.metric[static_cast<std::size_t>(3 * i + j)] = metric[i][j];
        }
    }
    if (!round(pair.linear) || !round(pair.offset) || !round(pair.metric)) return std::nullopt;
    // A coarse mesh of an open shape stands off what it stands for.
    if (other.open) {
        const Box& box = other.mesh->bounds;
        double radius = 0.0;
        for (const glm::dvec3& arm : armsOf(box))
            radius = std::max(radius, glm::length(objects * arm));
        margin += kPiece * radius;
    }
    pair.margin = roundedUp(margin / smallest);
    return pair;
}

/// Looks at one pair.
class Nearness {
  public:
    Nearness(const generator::Surface& surface, const ClosePair& pair)
        : surface_(surface),
          unitFromObject_(matrix(pair.linear)),
          metric_(matrix(pair.metric)),
          offset_(pair.offset[0], pair.offset[1], pair.offset[2]),
          margin_(pair.margin) {}

    /// True where the mesh crosses the surface at a small angle, or follows it, within the margin.
    bool meets(const MeshData& other) {
        const generator::Mesh& mesh = other.mesh;
        const Box& box = other.bounds;
        double radius = 0.0;
        for (const glm::dvec3& arm : armsOf(box))
            radius = std::max(radius, glm::length(unitFromObject_ * arm));
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
    static glm::dmat3 matrix(const std::array<double, 9>& columns) {
        return {columns[0], columns[1], columns[2], columns[3], columns[4],
                columns[5], columns[6], columns[7], columns[8]};
    }
    glm::dvec3 toUnit(const glm::dvec3& object) const { return unitFromObject_ * object + offset_; }
    double distance(const glm::dvec3& unit) const {
        return surface_.kind->distance(surface_, unit);
    }

    /// Gradient of the distance, units: away from the surface's nearest point.
    glm::dvec3 away(const glm::dvec3& unit, double here) const {
        constexpr double kChange = 1e-4;
        glm::dvec3 change;
        for (int i = 0; i < 3; ++i) {
            glm::dvec3 there = unit;
            there[i] += kChange;
            change[i] = distance(there) - here;
        }
        const double length = glm::length(change);
        return length > 0.0 ? change / length : glm::dvec3(0.0);
    }

    /// The surface's normal where it is nearest to `unit`; 0 where it has none there, as at a rim:
    /// a normal leads away from the surface on both of its sides.
    glm::dvec3 normalNear(const glm::dvec3& unit) const {
        constexpr double kStep = 0.05, kShare = 0.9;
        static constexpr std::array<glm::dvec3, 4> kAside{
            {{0.0, 0.0, 0.0}, {kStep, 0.0, 0.0}, {0.0, kStep, 0.0}, {0.0, 0.0, kStep}}};
        for (const glm::dvec3& aside : kAside) {
            const double here = distance(unit + aside);
            if (here < 1e-3) continue;  // on the surface, where the distance has no gradient
            const glm::dvec3 normal = away(unit + aside, here);
            const glm::dvec3 nearest = unit + aside - here * normal;
            if (std::min(distance(nearest + kStep * normal), distance(nearest - kStep * normal)) >=
                kShare * kStep)
                return normal;
        }
        return glm::dvec3(0.0);
    }

    /// Cosine of the angle between a piece's normal, a covector in units, and the surface's, both
    /// in world space; 0 where the surface has no normal.
    double cosine(const glm::dvec3& across, const glm::dvec3& normal) const {
        const double lengths = inWorld(across) * inWorld(normal);
        return lengths > 0.0 ? std::abs(glm::dot(across, metric_ * normal)) / lengths : 0.0;
    }
    /// Length of a covector in world space; of a unit normal 1 or less, the less the longer the
    /// surface is along it.
    double inWorld(const glm::dvec3& covector) const {
        return std::sqrt(std::max(0.0, glm::dot(covector, metric_ * covector)));
    }

    /// True where a small piece and all that is near it leave the surface at more than about 30
    /// degrees: the meshes' errors move such a crossing by hardly more than themselves. Angles are
    /// looked at in the piece's corners and middle.
    bool isSteep(const Piece& piece, const glm::dvec3& middle) const {
        constexpr double kSteep = 0.6;
        const glm::dvec3 across = glm::cross(piece[1] - piece[0], piece[2] - piece[0]);
        return cosine(across, normalNear(middle)) < kSteep &&
               std::all_of(piece.begin(), piece.end(), [&](const glm::dvec3& corner) {
                   return cosine(across, normalNear(corner)) < kSteep;
               });
    }

    /// True where a smallest piece that is near leaves the surface at less than 30 degrees, and is
    /// near by world units, too, where the surface's own are stretched.
    bool isShallow(const Piece& piece, const glm::dvec3& middle) const {
        constexpr double kShallow = 0.87;
        const glm::dvec3 normal = normalNear(middle);
        const glm::dvec3 across = glm::cross(piece[1] - piece[0], piece[2] - piece[0]);
        if (cosine(across, normal) < kShallow) return false;
        double apart = 0.0;
        for (const glm::dvec3& corner : piece)
            apart = std::max(apart, std::abs(glm::dot(corner - middle, normal)));
        return distance(middle) <= apart + margin_ * inWorld(normal);
    }

    bool isNear(const Piece& triangle, int depth) const {
        const glm::dvec3 middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
        double radius = 0.0;
        for (const glm::dvec3& corner : triangle)
            radius = std::max(radius, glm::length(corner - middle));
        if (distance(middle) > radius + margin_) return false;
        if (radius <= std::max(kPiece, margin_) || depth == kMaxPieceDepth)
            return isShallow(triangle, middle);
        if (radius <= kAnglesLookedAt && radius > kAnglesLookedAt / 2 && isSteep(triangle, middle))
            return false;
        const glm::dvec3 ab = (triangle[0] + triangle[1]) * 0.5,
                         bc = (triangle[1] + triangle[2]) * 0.5,
                         ca = (triangle[2] + triangle[0]) * 0.5;
        return isNear({ab, bc, ca}, depth + 1) || isNear({triangle[0], ab, ca}, depth + 1) ||
               isNear({ab, triangle[1], bc}, depth + 1) || isNear({ca, bc, triangle[2]}, depth + 1);
    }

    const generator::Surface& surface_;
    glm::dmat3 unitFromObject_, metric_;
    glm::dvec3 offset_;
    double margin_;
    std::vector<glm::dvec3> units_;
};

}  // namespace

std::vector<bool> needExactDepth(const InstanceList& list, const std::vector<Frustum::Side>& sides,
                                 const ViewTransform& view, double errorPx, ClosePairs& known) {
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
        const Instance &surface = list.instances[a.instance], &other = list.instances[b.instance];
        const std::optional<ClosePair> pair = pairOf(list, surface, other, margin);
        if (!pair) return;
        std::optional<bool> isClose = known.find(*pair);
        if (!isClose) {
            const auto index = static_cast<std::size_t>(surface.surface);
            isClose = Nearness(list.surfaces[index], *pair).meets(*other.mesh);
            known.put(*pair, *isClose);
        }
        if (!*isClose) return;
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
