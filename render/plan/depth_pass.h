#pragma once

#include <vector>

#include "render/plan/frame_plan.h"

namespace farol::render {

/// What a pass of depths alone, before the one that shades, is worth: pixels that another model
/// covers later are then shaded once.
struct DepthPass {
    std::vector<PassItem> occluders;  ///< batches whose depths save more than they cost
    int models = 0;                   ///< in them
    double overdraw = 1.0;  ///< fragments shaded without it over those visible, by their costs
};

/// Estimates it from boxes: each cell of a grid over the image follows, in the order of drawing,
/// which model's box its middle ray enters first. `shadings`: of a pixel, together with
/// `passes` the samples. No occluders where nothing is worth it.
DepthPass planDepthPass(const FramePlan& plan, int shadings, int passes);

}  // namespace farol::render
