#pragma once

#include <glm/glm.hpp>
#include <string>

#include "render/options.h"
#include "scene/files/locator.h"
#include "scene/scene.h"

namespace farol::render {

struct Background {
    glm::vec4 color{0.0F, 0.0F, 0.0F, 1.0F};  ///< alpha 0: transparent
    std::string path;                         ///< a picture that fills the window, or empty
};

/// The request's background over the scene's over black: "#rrggbb", "r,g,b" (0..255), a basic
/// colour's name, "transparent", or a picture of the assets. Throws Error option.range.
Background chooseBackground(const scene::Scene& scene, const PictureOptions& options,
                            const scene::Assets& assets);

}  // namespace farol::render
