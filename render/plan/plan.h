#pragma once

#include <glm/glm.hpp>

#include "render/gl_facts.h"
#include "render/options.h"
#include "render/plan/frame_plan.h"
#include "render/plan/instances.h"
#include "render/plan/mesh_library.h"
#include "scene/files/assets.h"
#include "scene/scene.h"

namespace farol::render {

/// Width and height that a picture will have, after scale. Throws Error limit.pixels.
glm::ivec2 pictureSize(const scene::Scene& scene, const PictureOptions& options);

/// Where the third-person camera holds its entity: in front of the eye, in eye space.
inline constexpr glm::dvec3 kEntityPlace{0.0, 0.0, -3.0};

/// Parts of a frame that are skipped because they cannot be seen. All on but in tests, which show
/// that the image is the same without.
struct Skipping {
    bool outside = true;         ///< models beyond the view's borders
    bool betweenSamples = true;  ///< models too small to cover a sample of any pixel
    bool lights = true;          ///< lights that add nothing to a model
    bool calls = true;           ///< draw calls of models that differ in their place alone
    bool hidden = true;          ///< shading of pixels that another model covers later
    bool background = true;      ///< samples where no model is
    bool notFinite = true;       ///< marks of pixels with NaN or infinity; off: they are magenta
};

/// Plans one frame of a resolved scene that was placed at options.timeS, for a GL. Throws Error as
/// Renderer::render does.
FramePlan plan(const scene::Scene& scene, const Placed& placed, const PictureOptions& options,
               const scene::Assets& assets, MeshLibrary& meshes, const GlFacts& gl,
               const Skipping& skipping = {});

}  // namespace farol::render
