#pragma once

#include "generator/entry.h"

namespace farol::generator::primitives {

/// An ellipsoid of half axes `radii` about the origin, poles on Y. x = rx sin a cos b,
/// z = rz cos a cos b: slices run from +Z towards +X, stacks from the south pole; quads are split
/// from bottom right to top left seen from outside. u = slice/slices, v = stack/stacks; the seam
/// column is doubled; one pole vertex a slice, u at its middle. `layout2017` starts the slices at
/// +X, where that engine has its seam. `atlas` is the same rectangle.
Mesh ellipsoid(const glm::dvec3& radii, std::size_t slices, std::size_t stacks, scene::UvLayout uv);

/// The surface of that mesh.
Surface ellipsoidSurface(const glm::dvec3& radii, scene::UvLayout uv);

ShapeEntry sphereEntry();

}  // namespace farol::generator::primitives
