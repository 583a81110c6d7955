#pragma once

#include <memory>

#include "scene/files/assets.h"
#include "tests/support/ray_caster/world.h"

namespace farol::accuracy {

/// The same files for both sides: "it.png" and "profile.ply".
struct Supplies {
    std::shared_ptr<scene::Assets> assets;
    reference::Files files;
};

/// A picture of smooth waves over fine noise: what a filter gets wrong shows. And a vase's profile.
Supplies supplies(int width, int height);

}  // namespace farol::accuracy
