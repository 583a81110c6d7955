#pragma once

#include "render/options.h"

namespace farol::render {

/// Sets the camera of a later frame of a turntable: the first frame's, turned by `angle` rad about
/// its target.
void turnEye(PictureOptions& options, const scene::Camera& first, double angle);

}  // namespace farol::render
