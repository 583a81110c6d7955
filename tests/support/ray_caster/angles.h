#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace farol::reference {

/// The angle about Y from +Z towards +X, as a share 0..1 of a turn.
inline double turnOf(const glm::dvec3& p) {
    const double turn = std::atan2(p.x, p.z) / (2.0 * std::numbers::pi);
    return turn < 0.0 ? turn + 1.0 : turn;
}

/// Its gradient; zero on the axis, where there is none.
inline glm::dvec3 turnGradient(const glm::dvec3& p) {
    const double square = p.x * p.x + p.z * p.z;
    if (!(square > 0.0)) return glm::dvec3(0.0);
    return glm::dvec3(p.z, 0.0, -p.x) / (square * 2.0 * std::numbers::pi);
}

/// The latitude as a share: 0 at the south pole, 1 at the north.
inline double latitudeOf(const glm::dvec3& p) {
    return 0.5 + std::atan2(p.y, std::hypot(p.x, p.z)) / std::numbers::pi;
}

inline glm::dvec3 latitudeGradient(const glm::dvec3& p) {
    const double r = std::hypot(p.x, p.z);
    if (!(r > 0.0)) return glm::dvec3(0.0);
    return glm::dvec3(-p.y * p.x / r, r, -p.y * p.z / r) / (glm::dot(p, p) * std::numbers::pi);
}

/// The ray's parameter nearest to `center`: roots are sought from there, where they are small.
template <class R>
double closestApproach(const R& ray, const glm::dvec3& center) {
    return glm::dot(center - ray.origin, ray.direction) / glm::dot(ray.direction, ray.direction);
}

}  // namespace farol::reference
