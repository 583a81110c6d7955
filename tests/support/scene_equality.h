#pragma once

#include "scene/scene.h"

namespace farol::scene {

/// True if both scenes say the same: all fields but the locations.
bool equal(const Scene& a, const Scene& b);

}  // namespace farol::scene
