#pragma once

#include "generator/entry.h"

namespace farol::generator::primitives {

/// How the texture of a frustum lies in `atlas` layout.
enum class FrustumAtlas { cylinder, cone };

/// The frustum of a cone: base of radius `bottom` on y = 0, top of radius `top` at y = height,
/// slices from +Z towards +X, side quads split from bottom right to top left seen from outside.
/// A radius of 0 is an apex: a fan whose apex has one vertex a slice, with the normal at its
/// middle; otherwise a disc closes the end. Side normal (sin a, (bottom - top)/height, cos a).
/// Texture `face`: side u = slice/slices (apex 0.5), v = stack/stacks; discs as discs.
Mesh frustum(double bottom, double top, double height, std::size_t slices, std::size_t stacks,
             scene::UvLayout uv, FrustumAtlas atlas);

/// The surface of that mesh; the texture layouts are those of its side.
Surface frustumSurface(double bottom, double top, double height, scene::UvLayout uv,
                       FrustumAtlas atlas);

/// The triangles of that mesh.
std::size_t frustumTriangles(double bottom, double top, std::size_t slices, std::size_t stacks);

ShapeEntry frustumEntry();

}  // namespace farol::generator::primitives
