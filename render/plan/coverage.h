#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/plan/frame_plan.h"

namespace farol::render {

/// Returns rectangles (x, y, width, height; px from the lower left) that hold all models of the
/// frame, one above the other. Empty where they would be most of the image, or where lines or a
/// backdrop reach beyond models.
std::vector<glm::ivec4> coveredRects(const FramePlan& plan);

}  // namespace farol::render
