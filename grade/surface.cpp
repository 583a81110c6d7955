#include "grade/surface.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace farol::grade {
namespace {

using generator::Mesh;

constexpr std::size_t kMostVertices = 100'000;
constexpr double kNearly = 0.98;     // of the corners: seams and poles may be split otherwise
constexpr double kSameCos = 0.9995;  // 1.8 degrees: less than between faces of 64 slices
constexpr float kSameUv = 0.004F;    // about a texel of 256
constexpr double kSamePlace = 1e-4;  // of the extents: what text files round

/// One corner in world space.
struct Corner {
    glm::dvec3 place{0.0}, normal{0.0};
    glm::dvec3 direction{0.0};  ///< the normal as a direction is transformed
    glm::vec2 uv{0.0F};
    bool seen = false;
};

glm::dvec3 unit(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

std::vector<Corner> cornersOf(const Piece& piece) {
    const Mesh& mesh = piece.mesh->mesh;
    const glm::dmat3 linear(piece.worldFromObject);
    glm::dmat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                        glm::cross(linear[0], linear[1]));
    if (glm::dot(linear[0], cofactor[0]) < 0.0) cofactor = -cofactor;
    std::vector<Corner> out(mesh.positions.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i].place = glm::dvec3(piece.worldFromObject * glm::dvec4(mesh.positions[i], 1.0));
        if (!mesh.normals.empty()) {
            out[i].normal = unit(cofactor * glm::dvec3(mesh.normals[i]));
            out[i].direction = unit(linear * glm::dvec3(mesh.normals[i]));
        }
        if (!mesh.uvs.empty()) out[i].uv = mesh.uvs[i];
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
        reach_ = kSamePlace * std::max(1e-9, glm::length(size));
        std::sort(corners_.begin(), corners_.end(), [this](const Corner& a, const Corner& b) {
            return a.place[axis_] < b.place[axis_];
        });
    }
    /// Calls `each` with every corner at that place.
    template <typename Each>
    bool at(const glm::dvec3& place, Each each) {
        auto one = std::lower_bound(
            corners_.begin(), corners_.end(), place[axis_] - reach_,
            [this](const Corner& corner, double from) { return corner.place[axis_] < from; });
        bool any = false;
        for (; one != corners_.end() && one->place[axis_] <= place[axis_] + reach_; ++one) {
            if (glm::length(one->place - place) > reach_) continue;
            any = true;
            each(*one);
        }
        return any;
    }
    double seen() const {
        const auto count = std::count_if(corners_.begin(), corners_.end(),
                                         [](const Corner& one) { return one.seen; });
        return static_cast<double>(count) /
               static_cast<double>(std::max<std::size_t>(1, corners_.size()));
    }

  private:
    std::vector<Corner> corners_;
    int axis_ = 0;
    double reach_ = 0.0;
};

/// Which of the ways of agreeing hold for a corner with some corner of the reference there.
struct Agreement {
    bool same = false, opposite = false, untransposed = false;
    bool uv = false, upsideDown = false, mirrored = false, both = false, swapped = false;

    void add(const Corner& theirs, const Corner& ours) {
        const double along = glm::dot(theirs.normal, ours.normal);
        same = same || along > kSameCos;
        opposite = opposite || along < -kSameCos;
        untransposed = untransposed || glm::dot(theirs.direction, ours.normal) > kSameCos;
        const auto near = [&](const glm::vec2& wanted) {
            const glm::vec2 off = glm::abs(wanted - ours.uv);
            return std::max(off.x, off.y) < kSameUv;
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

}  // namespace

bool Surface::same() const {
    return compared && common > kNearly && normalsSame > kNearly && windingReversed < 1 - kNearly &&
           (!uvs || uvSame > kNearly);
}

Surface compareSurfaces(const Piece& reference, const Piece& submission) {
    Surface out;
    const Mesh& theirs = reference.mesh->mesh;
    const Mesh& mine = submission.mesh->mesh;
    if (theirs.positions.empty() || mine.positions.empty() ||
        std::max(theirs.positions.size(), mine.positions.size()) > kMostVertices)
        return out;
    out.compared = true;
    Places places(cornersOf(reference));
    const std::vector<Corner> corners = cornersOf(submission);
    std::vector<std::optional<glm::dvec3>> wanted(corners.size());
    const bool normals = !theirs.normals.empty() && !mine.normals.empty();
    out.uvs = !theirs.uvs.empty() && !mine.uvs.empty();
    double met = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        Agreement agreement;
        double nearest = -2.0;
        if (!places.at(corners[i].place, [&](Corner& there) {
                there.seen = true;
                agreement.add(there, corners[i]);
                const double along = std::abs(glm::dot(there.normal, corners[i].normal));
                if (along > nearest) {
                    nearest = along;
                    wanted[i] = there.normal;
                }
            }))
            continue;
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
    out.common = std::min(met / static_cast<double>(corners.size()), places.seen());
    for (double* share :
         {&out.normalsSame, &out.normalsOpposite, &out.normalsUntransposed, &out.uvSame,
          &out.uvUpsideDown, &out.uvMirrored, &out.uvBoth, &out.uvSwapped})
        *share /= met;
    double faces = 0.0, reversed = 0.0, flat = 0.0;
    for (std::size_t t = 0; t + 2 < mine.indices.size(); t += 3) {
        const std::array<std::uint32_t, 3> at{mine.indices[t], mine.indices[t + 1],
                                              mine.indices[t + 2]};
        const glm::dvec3 across = glm::cross(corners[at[1]].place - corners[at[0]].place,
                                             corners[at[2]].place - corners[at[0]].place);
        if (glm::length(across) == 0.0) continue;
        faces += 1.0;
        // A mirrored place turns triangles round; the renderer knows.
        const double side =
            glm::determinant(glm::dmat3(submission.worldFromObject)) < 0.0 ? -1.0 : 1.0;
        const glm::dvec3 face = side * unit(across);
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
    return out;
}

}  // namespace farol::grade
