#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>

#include "render/mesh_library.h"
#include "render/options.h"
#include "scene/scene.h"

namespace farol::render {

/// What the tessellation of open shapes is measured against.
struct Sight {
    scene::Camera camera;
    int width = 512, height = 512;  ///< px
    double errorPx = 0.25;
    scene::Shading shading = scene::Shading::phong;
};

/// How fine a shape has to be whose bounding box is `bounds` (object space) and that stands at
/// viewFromObject, so that no point of its surface moves by more than sight.errorPx on the screen
/// (docs/accuracy.md), rounded down to a ladder of half powers of two so that an orbiting camera
/// meets the same meshes again. Curved shapes also get the divisions that their shading needs.
generator::Fineness fineness(const Box& bounds, const glm::dmat4& viewFromObject, bool textured,
                             const Sight& sight);

}  // namespace farol::render
