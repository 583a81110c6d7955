#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "generator/bezier.h"
#include "generator/fineness.h"

namespace farol::generator::primitives {

/// Divisions of a patch: `u` along its columns, `v` along its rows.
struct PatchLevel {
    std::size_t u = 1, v = 1;
};

/// Signed distances from a facet to its surface along the normal, least (<= 0) and greatest (>= 0).
struct FacetRange {
    double low = 0.0, high = 0.0;

    void add(double distance) {
        low = std::min(low, distance);
        high = std::max(high, distance);
    }
    double middle() const { return (low + high) / 2.0; }
};

/// Distance from a triangle to a surface of second order where it is greatest, from the distances
/// at the middles of its edges: at an edge, or within a triangle whose edges bend alike.
double facetPeak(double a, double b, double c);

/// The divisions of patches that share edges: neighbours divide an edge alike, so that they do not
/// crack. Opposite edges of a patch have one level, and so have all edges that are joined by such
/// steps (a class): each patch is a grid.
class PatchLevels {
  public:
    /// Measures how the patches bend, at 5 x 5 places each.
    PatchLevels(const std::vector<BezierPatch>& patches, const Fineness& fineness);

    PatchLevel of(std::size_t patch) const {
        return {levels_[classes_[patch].u], levels_[classes_[patch].v]};
    }
    /// The greatest level.
    std::size_t greatest() const;
    /// All levels, class by class.
    const std::vector<std::size_t>& all() const { return levels_; }

    /// The class of the patch's columns, or of its rows.
    std::size_t classOf(std::size_t patch, bool rows) const {
        return rows ? classes_[patch].v : classes_[patch].u;
    }
    /// Makes a class finer for an error that is `ratio` times the bound, > 1. Returns false where
    /// it is at its finest.
    bool refine(std::size_t index, double ratio);
    /// Triangles of all grids, at most (a collapsed edge folds some).
    std::size_t triangles() const;

  private:
    struct Classes {
        std::size_t u, v;
    };
    std::vector<Classes> classes_;  ///< of each patch
    std::vector<std::size_t> levels_;
};

}  // namespace farol::generator::primitives
