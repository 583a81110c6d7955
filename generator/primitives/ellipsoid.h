#pragma once

#include "generator/entry.h"

namespace farol::generator::primitives {

/// The sphere's mesh (sphere.h) with a separate half axis along each of X, Y and Z.
ShapeEntry ellipsoidEntry();

}  // namespace farol::generator::primitives
