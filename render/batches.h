#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/plan.h"

namespace farol::render {

/// Models that differ in nothing but their place: one mesh, one material, one texture, one set of
/// lights.
struct Batch {
    std::size_t first = 0;  ///< index into Batches::order
    std::size_t count = 0;
    bool instanced = false;  ///< drawn by one call
};

struct Batches {
    std::vector<std::uint32_t> order;  ///< indices into FramePlan::items, batch after batch
    std::vector<Batch> batches;
};

/// From this many on a batch is one call: fewer do not pay for a shader of their own.
inline constexpr std::size_t kLeastInstances = 8;

/// All items of the plan. Where two surfaces lie in one place the first of the document wins: a
/// model moves up to its likes only past models that it cannot meet, since no pixel is theirs in
/// common or their distances differ.
Batches batchesOf(const FramePlan& plan);

}  // namespace farol::render
