#pragma once

#include "render/options.h"
#include "render/plan/frame_plan.h"
#include "render/plan/instances.h"
#include "scene/scene.h"

namespace farol::render {

/// Returns the shading of a render: the request's, the scene's, else the automatic one: without
/// lights, colours and textures wireframe; without lights unlit; else lit per pixel.
scene::Shading chooseShading(const scene::Scene& scene, const PictureOptions& options,
                             const InstanceList& list);

/// True where lights light the models.
bool isLit(scene::Shading shading, const InstanceList& list);

/// True if an image of that style has the shadows that the request or the scene asks for; where it
/// cannot, a warning says why.
bool hasShadows(const scene::Scene& scene, const PictureOptions& options, const FrameStyle& style,
                const InstanceList& list, Diagnostics& findings);

}  // namespace farol::render
