#pragma once

#include "generator/entry.h"

namespace farol::generator::primitives {

/// A cone: base on XZ, apex at y = height (frustum.h with a top of radius 0). In `atlas` layout
/// base and side are discs side by side.
ShapeEntry coneEntry();

}  // namespace farol::generator::primitives
