#pragma once

#include <glm/glm.hpp>

namespace farol::generator {

/// The exact surface that the mesh of a curved shape stands for, in units of its own lengths:
/// q = position / lengths. An ellipsoid is the unit sphere; a frustum has the radius
/// form.x + form.y * q.y for q.y in 0..1, closed by discs; a torus the ring 1 and the tube form.x;
/// a ring lies in q.y = 0 between the radii form.x and 1. A turned profile is round about Y; its
/// outline is the mesh's own.
struct Surface {
    enum class Kind { ellipsoid, frustum, torus, ring, turned };
    Kind kind = Kind::ellipsoid;
    glm::dvec3 lengths{1.0};
    glm::dvec2 form{0.0};
    /// Texture coordinates of the curved part: u = uv.x + uv.y * turn, v = uv.z + uv.w * share. The
    /// turn 0..1 about Y runs from +Z towards +X (from +X towards -Z with turnFromX); the share
    /// 0..1 from pole to pole, up the side, about the tube, or from hole to rim; of a turned
    /// profile it is the mesh's own.
    glm::dvec4 uv{0.0, 1.0, 0.0, 1.0};
    /// Where the discs that close a frustum have their middles in the texture: bottom, top.
    glm::dvec4 discs{0.5};
    bool turnFromX = false;
    bool discUv = false;  ///< instead u = uv.x + uv.y * q.x, v = uv.z + uv.w * q.z
    bool operator==(const Surface&) const = default;
};

}  // namespace farol::generator
