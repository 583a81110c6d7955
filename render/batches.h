#pragma once

#include <cstddef>
#include <vector>

#include "render/plan.h"

namespace farol::render {

/// Neighbours in the plan's order that differ in nothing but their place: one mesh, one material,
/// one texture, one set of lights.
struct Batch {
    std::size_t first = 0;  ///< index into FramePlan::items
    std::size_t count = 0;
    bool instanced = false;  ///< drawn by one call
};

/// From this many on a batch is one call: fewer do not pay for a shader of their own.
inline constexpr std::size_t kLeastInstances = 8;

/// All items of the plan in their order: where two surfaces lie in one place the first one wins,
/// with instancing as without.
std::vector<Batch> batchesOf(const FramePlan& plan);

}  // namespace farol::render
