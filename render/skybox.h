#pragma once

#include <array>

#include "render/image.h"

namespace farol::render {

/// Cuts the 4x3 cross of a skybox into the faces +X -X +Y -Y +Z -Z of a cube map, each as large as
/// a quarter of the width, resampled to a square where the cells are not. The cross, seen from
/// inside, top row first:  . top . .  /  left front right back  /  . bottom . .
/// front is the world's -Z, right +X. Cube maps are left-handed (OpenGL 4.5 spec, table 8.19):
/// sample with the direction's z negated.
std::array<Image, 6> cutCross(const Image& cross);

}  // namespace farol::render
