#pragma once

#include <vector>

#include "render/plan/camera.h"
#include "render/plan/close_pairs.h"
#include "render/plan/frustum.h"
#include "render/plan/instances.h"

namespace farol::render {

/// Whether the pixels of each instance need the depth of its exact surface: another instance comes
/// so near to that surface, at less than about 30 degrees, that the meshes' errors, `errorPx` each,
/// could decide which one shows. `known`: answers of earlier frames, to which new ones are added.
/// Looks at pairs of which one is an open exact surface that rays can be followed to, both in view
/// (`sides` of the list's instances). May say yes within 2 % of a surface's size. Empty: of none.
/// Looks at kMaxExactSurfaces such surfaces and kMaxExactPairs pairs at most: frames of more are
/// left as their meshes are.
std::vector<bool> needExactDepth(const InstanceList& list, const std::vector<Frustum::Side>& sides,
                                 const ViewTransform& view, double errorPx, ClosePairs& known);

inline constexpr std::size_t kMaxExactSurfaces = 1024;
inline constexpr std::size_t kMaxExactPairs = 1'000'000;

}  // namespace farol::render
