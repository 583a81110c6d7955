#include "generator/surface.h"

#include <cmath>
#include <numbers>

namespace farol::generator {

double distanceToSegment(const glm::dvec2& eye, const glm::dvec2& from, const glm::dvec2& to) {
    const glm::dvec2 along = to - from;
    const double t = glm::clamp(glm::dot(eye - from, along) / glm::dot(along, along), 0.0, 1.0);
    return glm::length(eye - (from + t * along));
}

glm::dvec2 aboutY(const glm::dvec3& point) {
    return {std::sqrt(point.x * point.x + point.z * point.z), point.y};
}

double fullTurnOfSlices(const std::vector<double>& levels) { return levels.at(0); }

glm::dvec3 balanceOfSlices(double slices) {
    // The nearest point of a facet to the middle, on the unit circle.
    const double across = std::sin(std::numbers::pi / slices);
    const double scale = 2.0 / (1.0 + std::sqrt(1.0 - across * across));
    return {scale, 1.0, scale};
}

}  // namespace farol::generator
