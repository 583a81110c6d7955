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

/// The alpha of the picture: none; round holes with smooth edges; waves from 0.1 to 0.9.
enum class PatternAlpha { opaque, holes, waves };

/// A picture of smooth waves over fine noise: what a filter gets wrong shows. And a vase's profile.
Supplies supplies(int width, int height, PatternAlpha alpha = PatternAlpha::opaque);

}  // namespace farol::accuracy
