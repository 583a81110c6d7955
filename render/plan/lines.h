#pragma once

#include "render/plan/frame_plan.h"
#include "render/plan/instances.h"

namespace farol::render {

/// Adds the lines that a frame shows beside its models to FramePlan::lines: the axes, the curves
/// that groups follow, and the marker of the camera's target, as scene and options ask for them.
/// Reads the view and camera of the plan.
void addLines(FramePlan& plan, const scene::Scene& scene, const InstanceList& list,
              const PictureOptions& options);

}  // namespace farol::render
