#pragma once

#include <functional>

#include "scene/files/locator.h"
#include "scene/scene.h"

namespace farol::scene {

/// Returns where a model's triangles come from. Throws Error where it finds nothing.
using FindSource = std::function<ModelSource(const Model&)>;

/// Fills in Model::source of every model by `findSource`, and the paths of textures, background
/// and skybox (Texture::path, Background::path, Skybox::path) with the files that the locator
/// finds. Asks once for each name in a document. Makes planes of the 2017 dialect two-sided.
/// Adds an error for each missing file; does not throw. Does not visit the entity
/// (Scene::entity).
void resolveFiles(Scene& scene, Locator& locator, const FindSource& findSource,
                  Diagnostics& diagnostics);

}  // namespace farol::scene
