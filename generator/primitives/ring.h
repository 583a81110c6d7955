#pragma once

#include "generator/entry.h"

namespace farol::generator::primitives {

/// A flat ring in XZ about the origin with a face up and a face down, visible from both
/// sides; u = slice/slices from +Z towards +X, v = 0 at the inner edge, 1 at the outer.
/// An inner radius of 0 is a disc.
Mesh ring(double inner, double outer, std::size_t slices);

ShapeEntry ringEntry();

}  // namespace farol::generator::primitives
