#pragma once

#include "tests/support/ray_caster/shape.h"

namespace farol::reference {

/// A stretch (radius, height) -> (radius, height) turned about Y: a cone, a cylinder or a flat
/// ring. Running upwards, its outside looks away from the axis.
struct Segment {
    glm::dvec2 from, to;

    void intersect(const Ray& ray, int face, Nearest& nearest) const;
    /// Unit; at an apex, that of the +Z side.
    glm::dvec3 normalAt(const glm::dvec3& point) const;
    /// 0 at `from`, 1 at `to`.
    double shareAt(const glm::dvec3& point) const;
};

}  // namespace farol::reference
