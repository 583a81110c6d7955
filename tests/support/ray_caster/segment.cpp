#include "tests/support/ray_caster/segment.h"

#include <algorithm>
#include <cmath>

#include "tests/support/ray_caster/angles.h"
#include "tests/support/ray_caster/roots.h"

namespace farol::reference {

glm::dvec3 Segment::normalAt(const glm::dvec3& point) const {
    const glm::dvec2 along = to - from;
    const double r = std::hypot(point.x, point.z);
    const double sine = r > 0.0 ? point.x / r : 0.0, cosine = r > 0.0 ? point.z / r : 1.0;
    return glm::normalize(glm::dvec3(along.y * sine, -along.x, along.y * cosine));
}

double Segment::shareAt(const glm::dvec3& point) const {
    const glm::dvec2 along = to - from;
    return glm::dot(glm::dvec2(std::hypot(point.x, point.z), point.y) - from, along) /
           glm::dot(along, along);
}

void Segment::intersect(const Ray& ray, int face, Nearest& nearest) const {
    const glm::dvec2 along = to - from;
    const double size = std::max({from.x, to.x, std::abs(along.y)});
    const double shift = closestApproach(ray, {0.0, 0.5 * (from.y + to.y), 0.0});
    const glm::dvec3 o = ray.at(shift), d = ray.direction;
    Roots roots;
    if (along.y == 0.0) {
        const double s = (from.y - o.y) / d.y;
        if (std::isfinite(s)) roots.add(s);
    } else {
        // x^2 + z^2 = (r + k (y - y0))^2
        const double k = along.x / along.y, r = from.x + k * (o.y - from.y), g = k * d.y;
        roots = solveQuadratic(d.x * d.x + d.z * d.z - g * g, 2.0 * (o.x * d.x + o.z * d.z - r * g),
                               o.x * o.x + o.z * o.z - r * r);
    }
    for (const double s : roots) {
        const glm::dvec3 p = o + s * d;
        const double share = shareAt(p);
        // Neighbours share their rim: rounding must not open it.
        if (!(share >= -1e-12 && share <= 1.0 + 1e-12)) continue;
        // The cone goes on beyond its apex; that half lies off the segment.
        if (std::abs(std::hypot(p.x, p.z) - (from.x + share * along.x)) > 1e-6 * size) continue;
        nearest.offer(ray, shift + s, normalAt(p), face);
    }
}

}  // namespace farol::reference
