#pragma once

#include "generator/entry.h"

namespace farol::generator::primitives {

/// A torus about the origin, lying in XZ: the tube's centre runs at `ringRadius` from +Z towards
/// +X (u), the tube's angle (v) from the outermost point upwards; ringRadius > tubeRadius.
Mesh torus(double ringRadius, double tubeRadius, std::size_t rings, std::size_t sides);

ShapeEntry torusEntry();

}  // namespace farol::generator::primitives
