#pragma once

#include <array>

#include "image/image.h"

namespace farol::render {

/// Returns whether an image of that size, px, is a cross of 4 x 3 squares, within 1 %.
bool isCross(int width, int height);

/// Largest side of a face, px: that of a cross of kMaxTexturePixels with square cells. A cross of
/// other proportions would make faces many times its own size.
inline constexpr int kMaxFaceSide = 2309;

/// Cuts the 4x3 cross of a skybox into the faces +X -X +Y -Y +Z -Z of a cube map, each as large as
/// a quarter of the width and at most `maxSide`, resampled to a square where the cells are not. The
/// cross, seen from inside, top row first:  . top . .  /  left front right back  /  . bottom . .
/// front is the world's -Z, right +X. Cube maps are left-handed (OpenGL 4.5 spec, table 8.19):
/// sample with the direction's z negated.
std::array<image::Image, 6> cutCross(const image::Image& cross, int maxSide = kMaxFaceSide);

}  // namespace farol::render
