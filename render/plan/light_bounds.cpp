#include "render/plan/light_bounds.h"

#include <cmath>

namespace farol::render {
namespace {

/// A place in light space as LightView::min and max have it, and its distance along the light.
glm::dvec3 project(const glm::dvec3& light, bool isPerspective) {
    const double away = -light.z;
    return isPerspective ? glm::dvec3(light.x / away, light.y / away, away)
                         : glm::dvec3(light.x, light.y, away);
}

}  // namespace

glm::dmat3 rotationAlong(const glm::dvec3& forward) {
    // Across is level where it can be: a ground is then as short in the map as the light is low.
    glm::dvec3 up(0.0, 1.0, 0.0);
    if (std::abs(forward.y) > 0.9999) up = glm::dvec3(0.0, 0.0, -1.0);
    return rotationAlong(forward, up);
}

glm::dmat3 rotationAlong(const glm::dvec3& forward, const glm::dvec3& up) {
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    return glm::transpose(glm::dmat3(right, glm::cross(right, forward), -forward));
}

LightBounds boundsOf(const std::array<glm::dvec3, 8>& corners, const LightView& light,
                     bool& reachesBehind) {
    LightBounds bounds;
    bool isAnyBefore = false;
    reachesBehind = false;
    for (const glm::dvec3& corner : corners) {
        const glm::dvec3 at = light.rotation * (corner - light.origin);
        if (light.isPerspective && -at.z <= 1e-6 * glm::length(at)) {
            reachesBehind = true;
            continue;
        }
        isAnyBefore = true;
        bounds.add(project(at, light.isPerspective));
    }
    if (!isAnyBefore) return {};  // wholly behind
    if (reachesBehind) {
        bounds.min = glm::dvec3(-1e300, -1e300, 0.0);
        bounds.max = glm::dvec3(1e300, 1e300, bounds.max.z);
    }
    return bounds;
}

bool addInFront(const LightView& light, const std::vector<glm::dvec3>& places,
                LightBounds& bounds) {
    bool areInFront = true;
    for (const glm::dvec3& place : places) {
        const glm::dvec3 at = light.rotation * (place - light.origin);
        if (light.isPerspective && -at.z <= 1e-3 * glm::length(at))
            areInFront = false;
        else
            bounds.add(project(at, light.isPerspective));
    }
    return areInFront;
}

}  // namespace farol::render
