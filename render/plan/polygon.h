#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace farol::render {

/// A place is before it where dot(normal, place) + offset > 0.
struct ClipPlane {
    glm::dvec3 normal{0.0};
    double offset = 0.0;
    double distance(const glm::dvec3& place) const { return glm::dot(normal, place) + offset; }
};

using Polygon = std::vector<glm::dvec3>;

/// The part of a convex polygon before a plane (Sutherland and Hodgman 1974).
Polygon cutPolygon(const Polygon& polygon, const ClipPlane& plane);

}  // namespace farol::render
