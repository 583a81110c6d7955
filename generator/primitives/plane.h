#pragma once

#include "generator/entry.h"

namespace farol::generator::primitives {

/// A square of edge `size` in y = 0, centred at the origin, normal +Y, of divisions x divisions
/// quads split from (-x,-z) to (+x,+z); u along +X, v along -Z.
Mesh plane(double size, std::size_t divisions);

ShapeEntry planeEntry();

}  // namespace farol::generator::primitives
