#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "render/plan/shadow_maps.h"

namespace farol::render {

/// Bounds in a light's map: across and up as LightView::min and max have them, and along the light.
struct LightBounds {
    glm::dvec3 min{1e300}, max{-1e300};
    bool empty() const { return min.x > max.x; }
    void add(const glm::dvec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
};

/// LightView::rotation of a light that shines along a unit vector: across is level where it can be.
glm::dmat3 rotationAlong(const glm::dvec3& forward);
/// Likewise with `up` above, which must not be along the light.
glm::dmat3 rotationAlong(const glm::dvec3& forward, const glm::dvec3& up);

/// Where a box lies in the map; `reachesBehind`: a perspective has no bounds for it.
LightBounds boundsOf(const std::array<glm::dvec3, 8>& corners, const LightView& light,
                     bool& reachesBehind);

/// Adds where places lie in the map; false where one is behind the light.
bool addInFront(const LightView& light, const std::vector<glm::dvec3>& places, LightBounds& bounds);

}  // namespace farol::render
