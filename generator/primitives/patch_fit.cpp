#include "generator/primitives/patch_fit.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>

namespace farol::generator::primitives {
namespace {

using glm::dvec3;

constexpr double kFitMargin = 0.95;   // terms of third order, insides of facets
constexpr double kSmoothJoin = 0.97;  // cosine between the normals of neighbours: 14 degrees

/// An edge of the mesh: its ends, and where its middle is against the surface's own.
struct Edge {
    std::size_t from = 0, to = 0;  ///< of PatchGrid::points
    dvec3 surface{0.0};            ///< the surface's point
    dvec3 offset{0.0};             ///< from it to the edge's middle
    dvec3 normal{0.0, 1.0, 0.0};
    double height = 0.0;    ///< offset along the normal
    bool isBorder = false;  ///< the surface ends or has a crease there
};

/// Triangles of a mesh that is measured: each takes some 250 bytes meanwhile.
constexpr std::size_t kMaxFitted = 500'000;

struct Fitted {
    PatchGrid grid;
    std::vector<Edge> along, up, across;  ///< columns, rows, diagonals; row by row
    std::vector<FacetRange> ranges;       ///< of the facets round each vertex
    std::vector<dvec3> shifts;            ///< of each vertex
};

Edge edgeOf(const BezierPatch& patch, const PatchGrid& grid, std::size_t row, std::size_t column,
            std::size_t from, std::size_t to) {
    Edge edge{from, to};
    edge.surface = positionAt(patch, column, row, 2 * grid.level.u, 2 * grid.level.v);
    const PatchPoint &a = grid.points[from], &b = grid.points[to];
    edge.offset = (a.position + b.position) / 2.0 - edge.surface;
    const dvec3 both = a.normal + b.normal;
    edge.normal = glm::length(both) > 1e-9 ? glm::normalize(both) : a.normal;
    edge.height = glm::dot(edge.offset, edge.normal);
    return edge;
}

Fitted measured(const BezierPatch& patch, PatchLevel level) {
    Fitted out{PatchGrid(patch, level), {}, {}, {}, {}, {}};
    const PatchGrid& grid = out.grid;
    for (std::size_t i = 0; i <= level.v; ++i)
        for (std::size_t j = 0; j < level.u; ++j)
            out.along.push_back(
                edgeOf(patch, grid, 2 * i, 2 * j + 1, grid.at(i, j), grid.at(i, j + 1)));
    for (std::size_t i = 0; i < level.v; ++i)
        for (std::size_t j = 0; j <= level.u; ++j)
            out.up.push_back(
                edgeOf(patch, grid, 2 * i + 1, 2 * j, grid.at(i, j), grid.at(i + 1, j)));
    for (std::size_t i = 0; i < level.v; ++i)
        for (std::size_t j = 0; j < level.u; ++j)
            out.across.push_back(
                edgeOf(patch, grid, 2 * i + 1, 2 * j + 1, grid.at(i, j + 1), grid.at(i + 1, j)));
    return out;
}

/// Calls visit(corner, corner, corner, peak) for each triangle.
template <typename Visit>
void eachFacet(const Fitted& fitted, Visit visit) {
    const PatchGrid& grid = fitted.grid;
    const std::size_t columns = grid.level.u;
    for (std::size_t i = 0; i < grid.level.v; ++i)
        for (std::size_t j = 0; j < columns; ++j) {
            const double diagonal = fitted.across[i * columns + j].height;
            for (const std::size_t far : {std::size_t{0}, std::size_t{1}}) {
                const double u = fitted.along[(i + far) * columns + j].height;
                const double v = fitted.up[i * (columns + 1) + j + far].height;
                visit(grid.at(i, j + 1), grid.at(i + 1, j), grid.at(i + far, j + far),
                      facetPeak(u, v, diagonal));
            }
        }
}

/// A place where grids may meet: a vertex on the outside of a patch, or the middle of such an edge.
struct Place {
    std::array<std::int64_t, 3> key{};
    std::size_t patch = 0, index = 0;
    bool operator<(const Place& other) const { return key < other.key; }
};

class Fitter {
  public:
    Fitter(const std::vector<BezierPatch>& patches, const Fineness& fineness)
        : patches_(patches), fineness_(fineness) {
        double size = 0.0;
        for (const BezierPatch& patch : patches)
            for (const dvec3& p : patch)
                size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        grain_ = std::max(1e-300, 1e-6 * size);
    }

    void fit(const PatchLevels& levels) {
        fitted_.clear();
        for (std::size_t k = 0; k < patches_.size(); ++k)
            fitted_.push_back(measured(patches_[k], levels.of(k)));
        for (Fitted& one : fitted_) shift(one);
        joinVertices();
        findBorders();
    }

    /// Makes levels finer where a facet is too far from the surface; false where none is, or they
    /// are as fine as they get.
    bool improve(PatchLevels& levels) const {
        const double allowed = kFitMargin * fineness_.error;
        bool changed = false;
        // Of each patch, its columns and its rows.
        std::vector<std::array<double, 2>> worst(fitted_.size(), {0.0, 0.0});
        for (std::size_t k = 0; k < fitted_.size(); ++k) {
            const Fitted& one = fitted_[k];
            for (const Edge& edge : one.along)
                worst[k][0] = std::max(worst[k][0], errorOf(one, edge));
            for (const Edge& edge : one.up) worst[k][1] = std::max(worst[k][1], errorOf(one, edge));
            const auto bend = [](const std::vector<Edge>& edges) {
                double most = 0.0;
                for (const Edge& edge : edges) most = std::max(most, std::abs(edge.height));
                return most;
            };
            const std::size_t steeper = bend(one.up) > bend(one.along) ? 1 : 0;
            double& either = worst[k][steeper];
            for (const Edge& edge : one.across) either = std::max(either, errorOf(one, edge));
            eachFacet(one, [&](std::size_t a, std::size_t b, std::size_t c, double peak) {
                const dvec3 mean = (one.shifts[a] + one.shifts[b] + one.shifts[c]) / 3.0;
                const double moved = glm::dot(mean, one.grid.points[c].normal);
                either = std::max(either, std::abs(peak + moved));
            });
        }
        // All are measured at the same levels.
        std::map<std::size_t, double> asked;
        for (std::size_t k = 0; k < fitted_.size(); ++k)
            for (const bool rows : {false, true})
                if (worst[k][rows ? 1 : 0] > allowed) {
                    double& ratio = asked[levels.classOf(k, rows)];
                    ratio = std::max(ratio, worst[k][rows ? 1 : 0] / allowed);
                }
        for (const auto& [index, ratio] : asked) changed = levels.refine(index, ratio) || changed;
        return changed;
    }

    std::vector<PatchGrid> take() {
        std::vector<PatchGrid> grids;
        for (Fitted& one : fitted_) {
            for (std::size_t i = 0; i < one.shifts.size(); ++i)
                one.grid.points[i].position += one.shifts[i];
            grids.push_back(std::move(one.grid));
        }
        return grids;
    }

  private:
    std::array<std::int64_t, 3> keyOf(const dvec3& p) const {
        return {std::llround(p.x / grain_), std::llround(p.y / grain_), std::llround(p.z / grain_)};
    }

    static void shift(Fitted& one) {
        one.ranges.assign(one.grid.points.size(), {});
        for (const std::vector<Edge>* edges : {&one.along, &one.up, &one.across})
            for (const Edge& edge : *edges) {
                one.ranges[edge.from].add(edge.height);
                one.ranges[edge.to].add(edge.height);
            }
        eachFacet(one, [&](std::size_t a, std::size_t b, std::size_t c, double peak) {
            for (const std::size_t i : {a, b, c}) one.ranges[i].add(peak);
        });
        for (std::size_t i = 0; i < one.ranges.size(); ++i)
            one.shifts.push_back(-one.ranges[i].middle() * one.grid.points[i].normal);
    }

    /// Vertices at one place get one shift, by the ranges of all; at creases none.
    void joinVertices() {
        std::vector<Place> places;
        for (std::size_t k = 0; k < fitted_.size(); ++k) {
            const PatchGrid& grid = fitted_[k].grid;
            for (std::size_t i = 0; i <= grid.level.v; ++i)
                for (std::size_t j = 0; j <= grid.level.u; ++j)
                    if (i == 0 || j == 0 || i == grid.level.v || j == grid.level.u)
                        places.push_back(
                            {keyOf(grid.points[grid.at(i, j)].position), k, grid.at(i, j)});
        }
        std::stable_sort(places.begin(), places.end());
        for (std::size_t first = 0, end = 0; first < places.size(); first = end) {
            const dvec3 normal = pointOf(places[first]).normal;
            FacetRange range;
            bool smooth = true;
            for (end = first; end < places.size() && places[end].key == places[first].key; ++end) {
                const double cosine = glm::dot(pointOf(places[end]).normal, normal);
                smooth = smooth && std::abs(cosine) > kSmoothJoin;
                const FacetRange& own = fitted_[places[end].patch].ranges[places[end].index];
                range.add(cosine > 0.0 ? own.low : -own.low);
                range.add(cosine > 0.0 ? own.high : -own.high);
            }
            const dvec3 moved = smooth ? -range.middle() * normal : dvec3(0.0);
            for (std::size_t i = first; i < end; ++i)
                fitted_[places[i].patch].shifts[places[i].index] = moved;
        }
    }

    const PatchPoint& pointOf(const Place& place) const {
        return fitted_[place.patch].grid.points[place.index];
    }

    /// Marks the edges on the outside of a patch that no other patch continues smoothly.
    void findBorders() {
        std::vector<Place> places;
        for (std::size_t k = 0; k < fitted_.size(); ++k) {
            const Fitted& one = fitted_[k];
            const PatchLevel level = one.grid.level;
            for (std::size_t j = 0; j < level.u; ++j)
                for (const std::size_t i : {j, level.v * level.u + j})
                    places.push_back({keyOf(one.along[i].surface), k, i});
            for (std::size_t i = 0; i < level.v; ++i)
                for (const std::size_t j : {std::size_t{0}, level.u})
                    places.push_back({keyOf(one.up[i * (level.u + 1) + j].surface), k,
                                      one.along.size() + i * (level.u + 1) + j});
        }
        std::stable_sort(places.begin(), places.end());
        const auto edgeAt = [&](const Place& place) -> Edge& {
            Fitted& one = fitted_[place.patch];
            return place.index < one.along.size() ? one.along[place.index]
                                                  : one.up[place.index - one.along.size()];
        };
        for (std::size_t first = 0, end = 0; first < places.size(); first = end) {
            const dvec3 normal = edgeAt(places[first]).normal;
            bool smooth = true;
            for (end = first; end < places.size() && places[end].key == places[first].key; ++end)
                smooth =
                    smooth && std::abs(glm::dot(edgeAt(places[end]).normal, normal)) > kSmoothJoin;
            if (smooth && end - first > 1) continue;
            for (std::size_t i = first; i < end; ++i) edgeAt(places[i]).isBorder = true;
        }
    }

    /// Largest distance of the edge from the surface: along the normal; where the surface ends also
    /// across the edge; with a texture also along it.
    double errorOf(const Fitted& one, const Edge& edge) const {
        const dvec3 &from = one.shifts[edge.from], &to = one.shifts[edge.to];
        const dvec3 moved = edge.offset + (from + to) / 2.0;
        const double height = peakOf(glm::dot(from, edge.normal), glm::dot(to, edge.normal), edge);
        if (fineness_.textured) return std::max(height, glm::length(moved));
        if (!edge.isBorder) return height;
        const dvec3 along = one.grid.points[edge.to].position - one.grid.points[edge.from].position;
        const dvec3 side = glm::cross(edge.normal, along);
        const double length = glm::length(side);
        return length > 0.0 ? std::hypot(height, glm::dot(moved, side) / length)
                            : std::max(height, glm::length(moved));
    }

    /// Largest height over the edge, from those of its ends and the parabola between.
    static double peakOf(double from, double to, const Edge& edge) {
        const double bend = edge.height, slope = to - from;
        double middle = bend + (from + to) / 2.0;
        if (std::abs(slope) < 4.0 * std::abs(bend)) middle += slope * slope / (16.0 * bend);
        return std::max({std::abs(from), std::abs(to), std::abs(middle)});
    }

    const std::vector<BezierPatch>& patches_;
    const Fineness& fineness_;
    double grain_ = 0.0;
    std::vector<Fitted> fitted_;
};

}  // namespace

PatchGrid::PatchGrid(const BezierPatch& patch, PatchLevel divisions) : level(divisions) {
    points.reserve((level.u + 1) * (level.v + 1));
    for (std::size_t row = 0; row <= level.v; ++row)
        for (std::size_t column = 0; column <= level.u; ++column)
            points.push_back(evaluate(patch, column, row, level.u, level.v));
}

void addGrid(Builder& builder, const PatchGrid& grid) {
    const std::size_t columns = grid.level.u, rows = grid.level.v;
    const std::uint32_t base = builder.next();
    for (std::size_t row = 0; row <= rows; ++row)
        for (std::size_t column = 0; column <= columns; ++column) {
            const PatchPoint& point = grid.points[grid.at(row, column)];
            builder.vertex(point.position, point.normal,
                           {fraction(columns - column, columns), fraction(rows - row, rows)});
        }
    const auto at = [&](std::size_t row, std::size_t column) {
        return base + static_cast<std::uint32_t>(grid.at(row, column));
    };
    for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < columns; ++j) {
            builder.triangleUnlessFlat(at(i, j), at(i, j + 1), at(i + 1, j));
            builder.triangleUnlessFlat(at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
        }
}

std::vector<PatchGrid> fittedGrids(const std::vector<BezierPatch>& patches,
                                   const Fineness& fineness, PatchLevels& levels) {
    Fitter fitter(patches, fineness);
    do {
        if (levels.triangles() > kMaxFitted) return {};
        fitter.fit(levels);
    } while (fitter.improve(levels));
    return fitter.take();
}

}  // namespace farol::generator::primitives
