#pragma once

#include "generator/entry.h"

namespace farol::generator::primitives {

/// The upper half of a ball about the origin, closed by a flat base on XZ, pole at y = radius:
/// slices from +Z towards +X, stacks from the rim to the pole; quads are split from bottom right
/// to top left seen from outside. u = slice/slices, v = stack/stacks, 0 at the rim; the seam
/// column is doubled; one pole vertex a slice, u at its middle. The base is a fan with a disc of
/// the texture, +X to the right and +Z up seen from below. All texture layouts are this one.
Mesh dome(double radius, std::size_t slices, std::size_t stacks);

ShapeEntry domeEntry();

}  // namespace farol::generator::primitives
