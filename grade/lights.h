#pragma once

#include "grade/finding.h"
#include "grade/tree.h"

namespace farol::grade {

/// Lights, matched by what they do rather than by order: codes light.*. Lengths of directions do
/// not matter.
Findings compareLights(const Tree& reference, const Tree& submission);

/// The scenes' own cameras, as far as they show in a picture: codes camera.*. `sceneSize` is the
/// scene's extent in its own units.
Findings compareCameras(const scene::Camera& reference, const scene::Camera& submission,
                        double sceneSize);

}  // namespace farol::grade
