#pragma once

#include "image/image.h"
#include "scene/scene.h"

namespace farol::render {

/// Returns the image of a checker, at most 4096 px a side.
image::Image chessBoard(const scene::Chess& chess);

}  // namespace farol::render
