#include "render/plan/polygon.h"

namespace farol::render {

Polygon cutPolygon(const Polygon& polygon, const ClipPlane& plane) {
    Polygon out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3& a = polygon[i];
        const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
        const double before = plane.distance(a), after = plane.distance(b);
        if (before >= 0.0) out.push_back(a);
        if ((before >= 0.0) != (after >= 0.0))
            out.push_back(a + (b - a) * (before / (before - after)));
    }
    return out;
}

}  // namespace farol::render
