#pragma once

#include "generator/entry.h"

namespace farol::generator::primitives {

/// A cylinder: base on XZ, top at y = height (frustum.h with equal radii). In `atlas` layout the
/// side lies below both discs.
ShapeEntry cylinderEntry();

}  // namespace farol::generator::primitives
