#include "generator/primitives/patch_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace farol::generator::primitives {
namespace {

using glm::dvec3;

constexpr std::size_t kSteps = 4;  // of the places at which a patch is measured
constexpr std::size_t kSamples = (kSteps + 1) * (kSteps + 1);
/// Margin for points between the samples, and for terms of third order.
constexpr double kLevelMargin = 0.9;
/// Share of the divisions for shading that suffices where facets lie on both sides of the surface,
/// half as far from it.
constexpr double kCloser = 0.7;
/// Divisions by the root of the change of the normal's rate: interpolated normals are then off by
/// at most 0.0023 radians at 48 of a full turn, 2 levels in a highlight of shininess 36 to 50.
constexpr double kSwerve = 0.22;
/// Patches of such models span a quarter of a turn.
constexpr double kMaxLevel = kMaxDivisions / 4.0;

/// How a patch bends, from its derivatives by u and v.
struct Bends {
    std::array<glm::vec3, kSamples> normal{};  ///< along the normal: uu, uv, vv
    glm::dvec3 whole{0.0};                     ///< largest length: uu, uv, vv
    double edgeU = 0.0, edgeV = 0.0;           ///< of its open edges, across them in the surface
    double turnU = 0.0, turnV = 0.0;           ///< largest rate at which the normal turns, radians
    double swerveU = 0.0, swerveV = 0.0;       ///< largest change of that rate
};

/// Distances of the facets of a grid whose surface bends by so much over a cell: second
/// derivatives times the cell's sides.
FacetRange facetRange(double uu, double uv, double vv) {
    // An edge's middle is an eighth of the second derivative along it away.
    const double u = uu / 8.0, v = vv / 8.0, diagonal = (uu - 2.0 * uv + vv) / 8.0;
    FacetRange range;
    for (const double distance : {u, v, diagonal, facetPeak(u, v, diagonal)}) range.add(distance);
    return range;
}

/// Error of a patch whose cells have these sides.
double errorOf(const Bends& bends, double h, double k, const Fineness& fineness) {
    double worst = std::max(bends.edgeU * h * h, bends.edgeV * k * k) / 8.0;
    for (const glm::vec3& bend : bends.normal) {
        const FacetRange range =
            facetRange(double{bend.x} * h * h, double{bend.y} * h * k, double{bend.z} * k * k);
        worst = std::max(worst, fineness.balanced ? (range.high - range.low) / 2.0
                                                  : std::max(-range.low, range.high));
    }
    if (fineness.textured)
        worst = std::max(
            worst,
            (bends.whole.x * h * h + 2.0 * bends.whole.y * h * k + bends.whole.z * k * k) / 8.0);
    return worst;
}

/// Returns the length of `second` across `first`, in the surface.
double across(const dvec3& first, const dvec3& second, const dvec3& normal) {
    const dvec3 side = glm::cross(normal, first);
    const double length = glm::length(side);
    return length > 0.0 ? std::abs(glm::dot(second, side)) / length : glm::length(second);
}

double angle(const dvec3& a, const dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// How far the middle of three normals is from the mean of its neighbours, as a second derivative:
/// interpolated normals that turn at one rate are right.
double swerve(const dvec3& before, const dvec3& middle, const dvec3& after) {
    const dvec3 change = before - 2.0 * middle + after;
    return kSteps * kSteps * glm::length(change - middle * glm::dot(change, middle));
}

/// `open`: which edges no other patch shares: first and last row, first and last column.
Bends bendsOf(const BezierPatch& patch, const std::array<bool, 4>& open) {
    Bends out;
    std::array<dvec3, kSamples> normals{};
    for (std::size_t row = 0; row <= kSteps; ++row)
        for (std::size_t column = 0; column <= kSteps; ++column) {
            const std::size_t i = row * (kSteps + 1) + column;
            const dvec3 n = evaluate(patch, column, row, kSteps, kSteps).normal;
            const PatchBend bend = bendAt(patch, column, row, kSteps, kSteps);
            normals[i] = n;
            out.normal[i] = {glm::dot(bend.uu, n), glm::dot(bend.uv, n), glm::dot(bend.vv, n)};
            out.whole = glm::max(
                out.whole, dvec3(glm::length(bend.uu), glm::length(bend.uv), glm::length(bend.vv)));
            if ((row == 0 && open[0]) || (row == kSteps && open[1]))
                out.edgeU = std::max(out.edgeU, across(bend.u, bend.uu, n));
            if ((column == 0 && open[2]) || (column == kSteps && open[3]))
                out.edgeV = std::max(out.edgeV, across(bend.v, bend.vv, n));
        }
    for (std::size_t line = 0; line <= kSteps; ++line)
        for (std::size_t i = 0; i <= kSteps; ++i) {
            const auto along = [&](std::size_t k) { return normals[line * (kSteps + 1) + k]; };
            const auto up = [&](std::size_t k) { return normals[k * (kSteps + 1) + line]; };
            if (i > 0) {
                out.turnU = std::max(out.turnU, kSteps * angle(along(i - 1), along(i)));
                out.turnV = std::max(out.turnV, kSteps * angle(up(i - 1), up(i)));
            }
            if (i == 0 || i == kSteps) continue;
            out.swerveU = std::max(out.swerveU, swerve(along(i - 1), along(i), along(i + 1)));
            out.swerveV = std::max(out.swerveV, swerve(up(i - 1), up(i), up(i + 1)));
        }
    return out;
}

/// An edge's control points, rounded to a millionth of the size, from the lesser end.
using EdgeKey = std::array<std::int64_t, 12>;

EdgeKey keyOf(const std::array<dvec3, 4>& edge, double grid) {
    const auto listed = [&](bool reversed) {
        EdgeKey key{};
        for (std::size_t i = 0; i < 4; ++i)
            for (int c = 0; c < 3; ++c)
                key[3 * i + static_cast<std::size_t>(c)] =
                    std::llround(edge[reversed ? 3 - i : i][c] / grid);
        return key;
    };
    return std::min(listed(false), listed(true));
}

/// First and last row, first and last column, as indices of control points.
constexpr std::array<std::array<std::size_t, 4>, 4> kEdges{
    {{0, 1, 2, 3}, {12, 13, 14, 15}, {0, 4, 8, 12}, {3, 7, 11, 15}}};

std::size_t rootOf(std::vector<std::size_t>& parents, std::size_t i) {
    while (parents[i] != i) i = parents[i] = parents[parents[i]];
    return i;
}

}  // namespace

double facetPeak(double a, double b, double c) {
    const double largest = std::max({std::abs(a), std::abs(b), std::abs(c)});
    const double sum = std::abs(a) + std::abs(b) + std::abs(c);
    const bool alike = (a > 0.0 && b > 0.0 && c > 0.0) || (a < 0.0 && b < 0.0 && c < 0.0);
    // Eight times these are squared lengths in the metric of the surface; within an acute triangle
    // the peak is at its circumcentre, half the squared circumradius.
    if (alike && 2.0 * largest < sum)
        return 4.0 * a * b * c / (2.0 * (a * b + b * c + c * a) - (a * a + b * b + c * c));
    return std::abs(a) == largest ? a : std::abs(b) == largest ? b : c;
}

PatchLevels::PatchLevels(const std::vector<BezierPatch>& patches, const Fineness& fineness) {
    double size = 0.0;
    for (const BezierPatch& patch : patches)
        for (const dvec3& p : patch)
            size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const double grid = std::max(1e-300, 1e-6 * size);
    // Directions 2 k and 2 k + 1 are the columns and the rows of patch k.
    std::vector<std::size_t> parents(2 * patches.size());
    std::iota(parents.begin(), parents.end(), std::size_t{0});
    struct Shared {
        std::size_t direction, count;
    };
    std::map<EdgeKey, Shared> edges;
    std::vector<std::array<Shared*, 4>> edgesOf(patches.size());
    for (std::size_t k = 0; k < patches.size(); ++k)
        for (std::size_t e = 0; e < 4; ++e) {
            std::array<dvec3, 4> edge{};
            for (std::size_t i = 0; i < 4; ++i) edge[i] = patches[k][kEdges[e][i]];
            const std::size_t direction = 2 * k + e / 2;
            // A point has no divisions that could differ.
            const EdgeKey key = keyOf(edge, grid);
            if (std::equal(key.begin(), key.begin() + 9, key.begin() + 3)) {
                edgesOf[k][e] = nullptr;
                continue;
            }
            Shared& shared = edges.try_emplace(key, Shared{direction, 0}).first->second;
            ++shared.count;
            edgesOf[k][e] = &shared;
            parents[rootOf(parents, direction)] = rootOf(parents, shared.direction);
        }
    std::map<std::size_t, std::size_t> numbers;
    const auto classOf = [&](std::size_t direction) {
        return numbers.try_emplace(rootOf(parents, direction), numbers.size()).first->second;
    };
    std::vector<Bends> bends;
    for (std::size_t k = 0; k < patches.size(); ++k) {
        classes_.push_back({classOf(2 * k), classOf(2 * k + 1)});
        std::array<bool, 4> open{};
        for (std::size_t e = 0; e < 4; ++e)
            open[e] = edgesOf[k][e] != nullptr && edgesOf[k][e]->count == 1;
        bends.push_back(bendsOf(patches[k], open));
    }
    const double error = kLevelMargin * fineness.error;
    std::vector<double> least(numbers.size(), 1.0), wanted(numbers.size(), 1.0);
    for (std::size_t k = 0; k < patches.size(); ++k) {
        const Bends& bend = bends[k];
        double uu = bend.edgeU, uv = 0.0, vv = bend.edgeV;
        for (const glm::vec3& one : bend.normal) {
            uu = std::max(uu, std::abs(double{one.x}));
            uv = std::max(uv, std::abs(double{one.y}));
            vv = std::max(vv, std::abs(double{one.z}));
        }
        if (fineness.textured) {
            uu = bend.whole.x;
            uv = bend.whole.y;
            vv = bend.whole.z;
        }
        // Each direction has half of the error; a twist counts for both.
        const double u = std::sqrt(uu + uv), v = std::sqrt(vv + uv);
        if (u > 0.0 || v > 0.0) {
            const double smallest = 1e-3 * std::max(u, v);
            const double columns = std::max(smallest, u), rows = std::max(smallest, v);
            const double scale =
                std::sqrt(errorOf(bend, 1.0 / columns, 1.0 / rows, fineness) / error);
            wanted[classes_[k].u] = std::max(wanted[classes_[k].u], scale * columns);
            wanted[classes_[k].v] = std::max(wanted[classes_[k].v], scale * rows);
        }
        const auto require = [&](std::size_t index, double turn, double swerve) {
            const bool closer = fineness.balanced && !fineness.textured;
            const double whole = (closer ? kCloser : 1.0) * fineness.fullTurn;
            // A texture bends where the surface does not.
            const double byTurn = fineness.textured
                                      ? whole / 4.0
                                      : std::min(0.25, turn / (2.0 * std::numbers::pi)) * whole;
            const double bySwerve = whole * std::sqrt(swerve) * kSwerve;
            least[index] = std::max({least[index], byTurn, std::min(bySwerve, whole / 4.0)});
        };
        require(classes_[k].u, bend.turnU, bend.swerveU);
        require(classes_[k].v, bend.turnV, bend.swerveV);
    }
    for (std::size_t i = 0; i < least.size(); ++i)
        levels_.push_back(static_cast<std::size_t>(
            std::ceil(std::clamp(std::max(least[i], wanted[i]), 1.0, kMaxLevel))));
    // Neighbours asked for more in one direction leave the other less to do.
    std::vector<std::vector<std::size_t>> members(levels_.size());
    for (std::size_t k = 0; k < patches.size(); ++k) {
        members[classes_[k].u].push_back(k);
        if (classes_[k].v != classes_[k].u) members[classes_[k].v].push_back(k);
    }
    const auto holds = [&](std::size_t k) {
        const PatchLevel level = of(k);
        return errorOf(bends[k], 1.0 / static_cast<double>(level.u),
                       1.0 / static_cast<double>(level.v), fineness) <= error;
    };
    for (std::size_t i = 0; i < levels_.size(); ++i)
        while (static_cast<double>(levels_[i]) - 1.0 >= std::max(1.0, least[i])) {
            --levels_[i];
            if (std::all_of(members[i].begin(), members[i].end(), holds)) continue;
            ++levels_[i];
            break;
        }
}

std::size_t PatchLevels::greatest() const {
    return levels_.empty() ? 1 : *std::max_element(levels_.begin(), levels_.end());
}

bool PatchLevels::refine(std::size_t index, double ratio) {
    std::size_t& level = levels_[index];
    const double n = static_cast<double>(level);
    if (n >= kMaxLevel) return false;
    level = static_cast<std::size_t>(
        std::ceil(std::clamp(n * std::sqrt(std::clamp(ratio, 1.1, 4.0)), n + 1.0, kMaxLevel)));
    return true;
}

std::size_t PatchLevels::triangles() const {
    std::size_t triangles = 0;
    for (std::size_t k = 0; k < classes_.size(); ++k) triangles += 2 * of(k).u * of(k).v;
    return triangles;
}

}  // namespace farol::generator::primitives
