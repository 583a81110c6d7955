#pragma once

#include "core/error.h"
#include "scene/files/assets.h"
#include "scene/scene.h"

namespace farol::render {

/// Puts placeholders where a resolved scene lacks a file: a checkered unit box for a model without
/// a readable mesh, a checker for a texture without a readable image; a background or skybox
/// without one is left out. Adds an error for each file that is there and cannot be read; those
/// that are missing are in `diagnostics` already. Reads and decodes every file once.
void fillPlaceholders(scene::Scene& scene, const scene::Assets& assets, Diagnostics& diagnostics);

}  // namespace farol::render
