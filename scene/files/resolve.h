#pragma once

#include <functional>

#include "scene/files/locator.h"
#include "scene/scene.h"

namespace farol::scene {

/// Returns where a model's triangles come from. Throws Error where it finds nothing.
using FindSource = std::function<ModelSource(const Model&)>;

/// Fills in Model::source of every model by `findSource`, and Texture::path, Background::path and
/// Skybox::path with the files that the locator finds. Asks once for each name in a
/// document. Planes of the 2017
/// dialect become two-sided. Adds errors for what is missing; does not throw. The entity is not
/// visited.
void resolveFiles(Scene& scene, Locator& locator, const FindSource& findSource,
                  Diagnostics& diagnostics);

}  // namespace farol::scene
