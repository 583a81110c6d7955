#pragma once

#include <map>
#include <optional>
#include <utility>

#include "grade/requirements/inventory.h"

namespace farol::grade {

/// A way round another object.
struct Orbit {
    double periodS = 0.0;
    double radius = 0.0;  ///< mean distance of the middles, in the space of the group
};

/// What objects do with the time, and how they hang from one another. Found by sampling each period
/// of the transforms above them; answers are kept.
class Motion {
  public:
    explicit Motion(const Inventory& inventory) : inventory_(inventory) {}

    /// Returns whether the object's middle moves, world space.
    bool moves(std::size_t object) const;
    /// Returns whether a rotation with a time stands above it.
    bool turns(std::size_t object) const;
    /// Returns the curves above it, the innermost first, each with its place in the document.
    std::vector<std::pair<const scene::FollowCurve*, Location>> curvesOf(std::size_t object) const;
    /// Returns the way of `object` round `other`: its direction from `other` turns by at least five
    /// sixths of a circle in one period, in the space of a group around both (or the world) in
    /// which `other` stands still.
    std::optional<Orbit> orbit(std::size_t object, std::size_t other);
    /// Returns whether `object` hangs from the group of `other`: its groups go through the group
    /// that `other` stands in; or both are below one group, in which `other` does not move, and
    /// either `other` is at that group's origin and `object` is not, or `object` is the smaller one
    /// and always nearer to `other` than half way to the origin.
    bool hangsFrom(std::size_t object, std::size_t other);

  private:
    std::optional<Orbit> findOrbit(int node, std::size_t object, std::size_t other) const;
    bool findHanging(std::size_t object, std::size_t other) const;
    std::vector<double> sampledTimes(std::size_t object, std::size_t other) const;
    bool standsStill(std::size_t object, int node, const std::vector<double>& timesS,
                     double reach) const;
    double radiusIn(std::size_t object, int node) const;

    using Pair = std::pair<std::size_t, std::size_t>;
    const Inventory& inventory_;
    std::map<Pair, std::optional<Orbit>> orbits_;
    std::map<Pair, bool> hanging_;
};

}  // namespace farol::grade
