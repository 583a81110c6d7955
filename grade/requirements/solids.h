#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "grade/requirements/inventory.h"

namespace farol::grade {

/// Objects inside others, at the times of a rubric.
class Solids {
  public:
    /// A solid that an eye is inside of, a sky for instance, hides nothing. `eyes`: of the times.
    Solids(const Inventory& inventory, std::vector<double> timesS, std::vector<glm::dvec3> eyes);

    /// Returns a closed object that all of `object` is inside of at each of the times.
    std::optional<std::size_t> around(std::size_t object);

  private:
    bool isInside(std::size_t object, std::size_t other, std::size_t time);
    bool hasInside(std::size_t solid, const glm::dvec3& world, std::size_t time) const;
    bool isClosed(std::size_t object);

    const Inventory& inventory_;
    std::vector<double> timesS_;
    std::vector<glm::dvec3> eyes_;
    std::vector<std::vector<glm::dmat4>> worlds_;  ///< by time and object
    std::vector<std::vector<render::Box>> boxes_;  ///< likewise, world space
    std::map<std::uint64_t, bool> closed_;         ///< by mesh
};

}  // namespace farol::grade
