#pragma once

#include "generator/entry.h"

namespace farol::generator::primitives {

/// A box of edge lengths `size`, centred at the origin, each face of divisions x divisions quads
/// split from their min-coordinate to their max-coordinate corner. Texture: `face` the whole
/// picture a face, upright from outside (top and bottom: u along +X, v along +Z); `atlas` an
/// unfolded cross of 4 x 3 fields, left front right back in the middle row; `layout2017` as that
/// engine's files: front and back by (x, y), left and right by (z, y), top and bottom by (z, x).
Mesh box(const glm::dvec3& size, std::size_t divisions, scene::UvLayout uv);

/// `box DIM [DIV]` is a cube, `box X Y Z [DIV]` a box.
ShapeEntry boxEntry();

}  // namespace farol::generator::primitives
