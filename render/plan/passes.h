#pragma once

#include "render/gl_facts.h"
#include "render/plan/frame_plan.h"

namespace farol::render {

/// Makes the passes of a frame from its style, with the batches and the features of its items: one
/// pass, or several that are averaged, and for large targets as many for each band of rows.
void composePasses(FramePlan& plan, const GlFacts& gl);

}  // namespace farol::render
