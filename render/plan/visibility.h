#pragma once

#include <glm/glm.hpp>

#include "core/error.h"
#include "image/image.h"
#include "render/plan/camera.h"
#include "render/plan/instances.h"
#include "scene/scene.h"

/// Findings about scenes of which little or nothing shows. They read the placed scene alone: no GL.
namespace farol::render {

/// Returns whether fewer than one pixel in 2,000 differs from black and from the colour of the
/// first pixel: an image of a background alone.
bool isNearlyBlank(const image::Image& image);

/// Warns about lights that cannot have their intended effect in any view:
/// scene.light-unused (no model is in their group), scene.light-below (every light is directional
/// and shines from below), scene.light-inside (a closed solid that is lit from within only).
Diagnostics checkLighting(const InstanceList& list, double timeS);

/// Reasons why models do not show in a view.
struct HiddenModels {
    /// One warning scene.blank a reason: the number of models, the first one's place in the
    /// document, and the fix. Empty where no reason is known.
    Diagnostics findings;
    bool areAll = false;  ///< every model is hidden for one of them
};

/// Checks the first 2,000 models. `lit`: colours depend on lights.
HiddenModels findHidden(const scene::Scene& scene, const InstanceList& list,
                        const ViewTransform& view, bool lit, double timeS);

}  // namespace farol::render
