#include "grade/structure/surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "grade/structure/triangle_grid.h"

namespace farol::grade {
namespace {

using generator::Mesh;

constexpr std::size_t kMaxVertices = 100'000;
constexpr double kNearly = 0.98;  // of the corners: seams and poles may be split otherwise
constexpr double kMinShare = 0.9;
constexpr double kSameNormalCos = 0.9995;  // 1.8 degrees: less than between faces of 64 slices
constexpr double kNearNormalCos = 0.985;   // 10 degrees: of another division's flank
constexpr float kSameUv = 0.004F;          // about a texel of 256
constexpr float kNearUv = 0.02F;
constexpr double kSamePlace = 1e-4;  // of the extents: rounding in text files
constexpr double kOnSurface = 4e-3;  // of the extents: facets of 96 divisions
constexpr double kCovered = 0.05;    // of the extents: facets of 16 divisions

/// One corner in the reference's object space.
struct Corner {
    glm::dvec3 place{0.0}, normal{0.0};
    glm::dvec3 direction{0.0};  ///< the normal as a direction is transformed
    glm::vec2 uv{0.0F};
    bool isSeen = false;
};

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

std::vector<Corner> cornersOf(const Mesh& mesh, const glm::dmat4& matrix) {
    const glm::dmat3 linear(matrix);
    glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                        glm::cross(linear[0], linear[1]));
    if (glm::dot(linear[0], cofactor[0]) < 0.0) cofactor = -cofactor;
    std::vector<Corner> out(mesh.positions().size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].place = glm::dvec3(matrix * glm::dvec4(mesh.positions()[i], 1.0));
        if (!mesh.normals().empty()) {
            out[i].normal = unit(cofactor * glm::dvec3(mesh.normals()[i]));
            out[i].direction = unit(linear * glm::dvec3(mesh.normals()[i]));
        }
        if (!mesh.uvs().empty()) out[i].uv = mesh.uvs()[i];
    }
    return out;
}

/// The reference's corners by place: sorted along the longest extent.
class Places {
  public:
    explicit Places(std::vector<Corner> corners) : corners_(std::move(corners)) {
        glm::dvec3 low(1e300), high(-1e300);
        for (const Corner& one : corners_) {
            low = glm::min(low, one.place);
            high = glm::max(high, one.place);
        }
        const glm::dvec3 size = high - low;
        axis_ = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        size_ = std::max(1e-9, glm::length(size));
        std::sort(corners_.begin(), corners_.end(), [this](const Corner& a, const Corner& b) {
            return a.place[axis_] < b.place[axis_];
        });
    }
    /// Calls `each` with every corner at that place.
    template <typename Each>
    bool at(const glm::dvec3& place, Each each) {
        const double reach = kSamePlace * size_;
        auto one = std::lower_bound(
            corners_.begin(), corners_.end(), place[axis_] - reach,
            [this](const Corner& corner, double from) { return corner.place[axis_] < from; });
        bool any = false;
        for (; one != corners_.end() && one->place[axis_] <= place[axis_] + reach; ++one) {
            if (glm::length(one->place - place) > reach) continue;
            any = true;
            each(*one);
        }
        return any;
    }
    double size() const { return size_; }
    std::vector<Corner>& corners() { return corners_; }

  private:
    std::vector<Corner> corners_;
    int axis_ = 0;
    double size_ = 1.0;
};

/// Which of the ways of agreeing hold for a corner with some point of the reference there.
struct Agreement {
    bool same = false, opposite = false, untransposed = false;
    bool uv = false, upsideDown = false, mirrored = false, both = false, swapped = false;

    void add(const Corner& theirs, const Corner& ours, double cosine, float uvReach) {
        const double along = glm::dot(theirs.normal, ours.normal);
        same = same || along > cosine;
        opposite = opposite || along < -cosine;
        untransposed = untransposed || glm::dot(theirs.normal, ours.direction) > cosine;
        const auto near = [&](const glm::vec2& wanted) {
            const glm::vec2 off = glm::abs(wanted - ours.uv);
            return std::max(off.x, off.y) < uvReach;
        };
        const glm::vec2 t = theirs.uv;
        uv = uv || near(t);
        upsideDown = upsideDown || near({t.x, 1.0F - t.y});
        mirrored = mirrored || near({1.0F - t.x, t.y});
        both = both || near(1.0F - t);
        swapped = swapped || near({t.y, t.x});
    }
};

/// The sign of a face against the reference's normals at its corners: 1, -1, or 0.
int facing(const glm::dvec3& face, const std::vector<std::optional<glm::dvec3>>& normals,
           const std::array<std::uint32_t, 3>& corners) {
    double along = 0.0;
    for (const std::uint32_t corner : corners)
        if (normals[corner]) along += glm::dot(face, *normals[corner]);
    return along > 0.0 ? 1 : along < 0.0 ? -1 : 0;
}

/// Measures the shares of faces with reversed winding, and of faces with flat normals.
void measureFaces(Surface& out, const Mesh& mine, const std::vector<Corner>& corners,
                  const std::vector<std::optional<glm::dvec3>>& wanted, bool isMirrored) {
    double faces = 0.0, reversed = 0.0, flat = 0.0;
    for (std::size_t t = 0; t + 2 < mine.indices().size(); t += 3) {
        const std::array<std::uint32_t, 3> at{mine.indices()[t], mine.indices()[t + 1],
                                              mine.indices()[t + 2]};
        const glm::dvec3 across = glm::cross(corners[at[1]].place - corners[at[0]].place,
                                             corners[at[2]].place - corners[at[0]].place);
        if (glm::length(across) == 0.0) continue;
        faces += 1.0;
        // A mirrored place turns triangles round; the renderer knows.
        const glm::dvec3 face = (isMirrored ? -1.0 : 1.0) * unit(across);
        if (facing(face, wanted, at) < 0) reversed += 1.0;
        bool all = true;
        for (const std::uint32_t corner : at)
            all = all && std::abs(glm::dot(face, corners[corner].normal)) > 0.9999;
        if (all) flat += 1.0;
    }
    if (faces > 0.0) {
        out.windingReversed = reversed / faces;
        out.normalsOfFaces = flat / faces;
    }
}

}  // namespace

bool Surface::isOnePlace() const { return isCompared && common > kMinShare; }

bool Surface::isSame(bool textured) const {
    return isCompared && common > kNearly && normalsSame > kMinShare &&
           windingReversed < 1 - kMinShare && (!hasUvs || !textured || uvSame > kMinShare);
}

Surface compareSurfaces(const KnownMesh& known, const Mesh& mine,
                        const glm::dmat4& theirsFromMine) {
    Surface out;
    const Mesh& theirs = known.mesh();
    if (theirs.positions().empty() || mine.positions().empty() ||
        std::max(theirs.positions().size(), mine.positions().size()) > kMaxVertices)
        return out;
    out.isCompared = true;
    Places places(cornersOf(theirs, glm::dmat4(1.0)));
    const std::vector<Corner> corners = cornersOf(mine, theirsFromMine);
    std::vector<std::optional<glm::dvec3>> wanted(corners.size());
    const bool normals = !theirs.normals().empty() && !mine.normals().empty();
    out.hasUvs = !theirs.uvs().empty() && !mine.uvs().empty();
    double met = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        Agreement agreement;
        double nearest = -2.0;
        const auto meet = [&](const Corner& there, double cosine, float uvReach) {
            agreement.add(there, corners[i], cosine, uvReach);
            const double along = std::abs(glm::dot(there.normal, corners[i].normal));
            if (along > nearest) {
                nearest = along;
                wanted[i] = there.normal;
            }
        };
        bool isMet = places.at(corners[i].place, [&](Corner& there) {
            there.isSeen = true;
            meet(there, kSameNormalCos, kSameUv);
        });
        if (!isMet)
            isMet = known.grid().triangles.near(
                corners[i].place, kOnSurface * places.size(), [&](const SurfacePoint& there) {
                    Corner point;
                    point.normal = point.direction = unit(there.normal);
                    point.uv = there.uv;
                    meet(point, kNearNormalCos, kNearUv);
                });
        if (!isMet) continue;
        met += 1.0;
        out.normalsSame += agreement.same || !normals ? 1.0 : 0.0;
        out.normalsOpposite += agreement.opposite && !agreement.same ? 1.0 : 0.0;
        out.normalsUntransposed += agreement.untransposed ? 1.0 : 0.0;
        out.uvSame += agreement.uv ? 1.0 : 0.0;
        out.uvUpsideDown += agreement.upsideDown ? 1.0 : 0.0;
        out.uvMirrored += agreement.mirrored ? 1.0 : 0.0;
        out.uvBoth += agreement.both ? 1.0 : 0.0;
        out.uvSwapped += agreement.swapped ? 1.0 : 0.0;
    }
    if (met == 0.0) return out;
    double covered = 0.0;
    std::optional<TriangleGrid> back;
    for (Corner& one : places.corners()) {
        if (!one.isSeen) {
            if (!back) back.emplace(mine, theirsFromMine);
            one.isSeen =
                back->near(one.place, kCovered * places.size(), [](const SurfacePoint&) {});
        }
        covered += one.isSeen ? 1.0 : 0.0;
    }
    out.common = std::min(met / static_cast<double>(corners.size()),
                          covered / static_cast<double>(places.corners().size()));
    for (double* share :
         {&out.normalsSame, &out.normalsOpposite, &out.normalsUntransposed, &out.uvSame,
          &out.uvUpsideDown, &out.uvMirrored, &out.uvBoth, &out.uvSwapped})
        *share /= met;
    measureFaces(out, mine, corners, wanted, glm::determinant(glm::dmat3(theirsFromMine)) < 0.0);
    return out;
}

Moments momentsOf(const Mesh& mesh, const glm::dmat4& matrix) {
    Moments out;
    std::vector<glm::dvec3> places;
    places.reserve(mesh.positions().size());
    for (const glm::vec3& position : mesh.positions())
        places.push_back(glm::dvec3(matrix * glm::dvec4(position, 1.0)));
    glm::dmat3 squares(0.0);
    for (std::size_t t = 0; t + 2 < mesh.indices().size(); t += 3) {
        const glm::dvec3 &a = places[mesh.indices()[t]], &b = places[mesh.indices()[t + 1]],
                         &c = places[mesh.indices()[t + 2]];
        const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
        const glm::dvec3 middle = (a + b + c) / 3.0;
        out.area += area;
        out.middle += area * middle;
        for (const glm::dvec3& p : {0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)})
            squares += (area / 3.0) * glm::outerProduct(p, p);
    }
    if (out.area > 0.0) {
        out.middle /= out.area;
        out.spread = squares / out.area - glm::outerProduct(out.middle, out.middle);
    }
    return out;
}

}  // namespace farol::grade
