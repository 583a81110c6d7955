#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/eye_light.h"
#include "render/instances.h"
#include "render/mesh_library.h"
#include "render/options.h"
#include "render/renderer.h"
#include "render/texture_ref.h"
#include "scene/assets.h"
#include "scene/scene.h"

/// What a frame draws and how, decided before any GL. Matrices are composed in double; what
/// stands here in float is relative to the eye. Eye space: viewer at the origin, looking at -Z.
namespace farol::render {

struct DrawItem {
    std::shared_ptr<const MeshData> mesh;
    glm::mat4 viewFromObject{1.0F};
    glm::mat3 normalFromObject{1.0F};  ///< cofactor matrix, any positive scale, outward
    /// Where the pixels take normals and coordinates from the surface itself: normalFromObject is
    /// then for gradients in the surface's units.
    std::optional<generator::Surface> surface;
    glm::vec3 unitFromObject{1.0F};  ///< scale from the mesh to the surface's units
    glm::vec3 surfaceEye{0.0F};      ///< the viewer in the surface's units
    bool inside = false;             ///< the insides are drawn
    bool mirrored = false;           ///< determinant < 0: front faces are clockwise
    glm::vec3 diffuse{0.0F}, ambient{0.0F}, specular{0.0F}, emissive{0.0F};
    float shininess = 0.0F;
    int texture = -1;  ///< index into FramePlan::textures
    scene::Mapping mapping = scene::Mapping::mesh;
    glm::vec4 planeS{0.0F}, planeT{0.0F};
    int lightSet = 0;      ///< index into FramePlan::lightSets
    std::uint32_t id = 0;  ///< 1.. in document order, for layer=id
};

/// A segment in eye space.
struct LineVertex {
    glm::vec3 position;
    glm::vec3 color;
};

struct FramePlan {
    bool instancing = true;  ///< batches are drawn by one call each (render/batches.h)
    int width = 512, height = 512;
    int samples = 1;
    scene::Shading shading = scene::Shading::phong;
    bool lit = true;  ///< false: materials show as their plain diffuse colour
    scene::Viewer viewer = scene::Viewer::infinite;
    scene::Specular specular = scene::Specular::single;
    Layer layer = Layer::color;
    glm::vec3 globalAmbient{1.0F};
    scene::Camera camera;
    glm::mat3 worldFromView{1.0F};
    std::vector<DrawItem> items;
    std::vector<std::vector<EyeLight>> lightSets;
    std::vector<TextureRef> textures;
    std::vector<LineVertex> lines;     ///< pairs
    std::vector<LineVertex> overlays;  ///< pairs, drawn over everything
    glm::vec4 background{0.0F, 0.0F, 0.0F, 1.0F};
    int backgroundTexture = -1, skyboxTexture = -1;  ///< indices into textures
    Diagnostics findings;                            ///< of the mesh files
    Stats stats;
};

/// Width and height that a picture will have, after scale. Throws Error limit.pixels.
glm::ivec2 pictureSize(const scene::Scene& scene, const PictureOptions& options);

/// What may be left out of a frame because nothing of it can be seen. All on but in tests, which
/// show that the picture is the same without.
struct Skipping {
    bool outside = true;         ///< what is beyond the view's borders
    bool betweenSamples = true;  ///< what is too small to be met by a sample of any pixel
    bool lights = true;          ///< lights that add nothing to a model
    bool calls = true;           ///< draw calls of models that differ in their place alone
};

/// Plans one frame of a resolved scene that was placed at options.timeS. Throws Error as
/// Renderer::render does.
FramePlan plan(const scene::Scene& scene, const Placed& placed, const PictureOptions& options,
               const scene::Assets& assets, MeshLibrary& meshes, const Skipping& skipping = {});

/// The same, placed just for it.
FramePlan plan(const scene::Scene& scene, const PictureOptions& options,
               const scene::Assets& assets, MeshLibrary& meshes, const Skipping& skipping = {});

}  // namespace farol::render
