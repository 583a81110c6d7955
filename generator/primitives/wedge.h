#pragma once

#include "generator/entry.h"

namespace farol::generator::primitives {

/// A right triangular prism, a ramp that rises away from the viewer: base on XZ about the origin,
/// `size.x` wide along X and `size.z` deep along Z. The upright face stands at z = -size.z / 2, the
/// ridge is its upper edge at y = size.y, and the slope falls to the edge on XZ at z = +size.z / 2.
/// The triangular ends face -X and +X. Texture: `face` the whole picture a face, upright from
/// outside (an end shows its triangle's part; bottom: u along +X, v along +Z); `atlas` an unfolded
/// 3 x 2 grid: left, slope and right below, bottom and back above; `layout2017` as `face`.
Mesh wedge(const glm::dvec3& size, scene::UvLayout uv);

ShapeEntry wedgeEntry();

}  // namespace farol::generator::primitives
