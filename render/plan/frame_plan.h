#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "core/error.h"
#include "generator/registry.h"
#include "image/alpha.h"
#include "render/options.h"
#include "render/plan/camera.h"
#include "render/plan/eye_light.h"
#include "render/plan/features.h"
#include "render/plan/mesh_library.h"
#include "render/plan/report.h"
#include "render/plan/shadow_maps.h"
#include "render/plan/texture_ref.h"
#include "scene/scene.h"

/// The passes of a frame and the tables that they draw from, decided before any GL. Matrices are
/// composed in double; floats here are relative to the eye.
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
    bool isOnSurface = false;        ///< its vertices are; pixels need no step to it
    /// How far the drawn surface may be beside the one that its light is worked out for: texels of
    /// a shadow map; share of the distance; and of faces turned away, but lit by smooth normals,
    /// units.
    glm::vec3 shadowOffset{0.0F};
    bool hasExactDepth = false;  ///< pixels have the surface's depth, not the mesh's
    bool inside = false;         ///< the insides are drawn
    bool mirrored = false;       ///< determinant < 0: front faces are clockwise
    glm::vec3 diffuse{0.0F}, ambient{0.0F}, specular{0.0F}, emissive{0.0F};
    float shininess = 0.0F;
    float opacity = 1.0F;
    image::Alpha alpha = image::Alpha::opaque;  ///< of opacity and texture; see transparency.h
    bool isBody = false;                        ///< its inner side shows where it is see-through
    bool isInner = false;                       ///< made by arrangeSeeThrough
    int texture = -1;                           ///< index into FramePlan::textures
    scene::Mapping mapping = scene::Mapping::mesh;
    glm::vec4 planeS{0.0F}, planeT{0.0F};
    glm::vec4 uvFrom{1.0F, 1.0F, 0.0F, 0.0F};  ///< scale and offset of the mesh's coordinates
    bool colored = false;                      ///< by the mesh's own colours
    std::size_t firstIndex = 0, indices = 0;   ///< the part of the mesh that is drawn
    int lightSet = 0;                          ///< index into FramePlan::lightSets
    int depthRank = 0;                         ///< steps of depth offset away (coplanar.h)
    std::uint32_t id = 0;                      ///< 1.. in document order, for layer=id
};

/// Models that differ in nothing but their place: one mesh, one material, one texture, one set of
/// lights.
struct Batch {
    std::size_t first = 0;  ///< index into Batches::order
    std::size_t count = 0;
    bool instanced = false;  ///< drawn by one call
    // Made of its items by composePasses.
    FeatureSet features;
    glm::vec3 plainColor{0.0F};  ///< where nothing lights them
};

struct Batches {
    std::vector<std::uint32_t> order;  ///< indices into FramePlan::items, batch after batch
    std::vector<Batch> batches;
    std::size_t firstBlended = 0;  ///< of batches: those from here on are see-through
};

/// A segment's end in eye space.
struct LineVertex {
    glm::vec3 position;
    glm::vec3 color;
};

/// Draw calls of one kind within a pass.
struct PassItem {
    enum class Kind {
        models,   ///< batches
        blended,  ///< batches over what is drawn, the farthest first
        peeled,   ///< batches over what is drawn, in the order of each pixel
        lines,
        skybox,  ///< where nothing is drawn yet: the surroundings in a cube map
        picture  ///< likewise: a texture that fills the window
    };
    Kind kind = Kind::models;
    std::size_t first = 0, count = 0;  ///< of FramePlan::batches, or of its lines (pairs)
    int texture = -1;                  ///< of skybox and picture: index into FramePlan::textures
};

/// Use of the pixels that a pass has drawn.
enum class PassOutput {
    none,  ///< they stay for the next pass
    mean   ///< rows of the image are their mean, and that of all such passes of the same rows
};

/// Where a pass draws. Passes in a row with the same target share its pixels.
struct PassTarget {
    int scale = 1;    ///< size of the target by that of the rows of the image, along each axis
    int samples = 1;  ///< of its pixel; 1, or the size of one of GlFacts::samplePatterns
    int firstRow = 0, rows = 0;           ///< of the image, from its top
    std::optional<glm::vec4> clearColor;  ///< none: every sample is drawn, or kept
    bool clearDepth = true;
    PassOutput output = PassOutput::mean;
};

enum class Polygons { filled, outlined, cornered };

struct PassState {
    bool depthTest = true;
    bool depthOnly = false;                ///< no colours, and depths a little behind the surfaces'
    Polygons polygons = Polygons::filled;  ///< of models
};

struct Pass {
    PassTarget target;
    PassState state;
    glm::dmat4 clip{1.0};  ///< clipFromEye: that of the view, moved by part of a pixel
    std::vector<PassItem> items;
    FeatureSet features;                          ///< of all models
    FeatureSet itemFeatures = FeatureSet::all();  ///< those of Batch::features that it uses
};

/// Choices that passes and features follow from.
struct FrameStyle {
    Layer layer = Layer::color;
    int samples = 1;  ///< lower bound
    scene::Shading shading = scene::Shading::phong;
    bool hasShadows = false;
    bool lit = true;  ///< false: materials show as their plain diffuse colour
    scene::Viewer viewer = scene::Viewer::infinite;
    scene::Specular specular = scene::Specular::single;
    scene::Transparency transparency = scene::Transparency::on;
    bool marksNotFinite = false;  ///< pixels with NaN or infinity are magenta
    bool mergesCalls = true;      ///< of models that differ in their place alone
    bool crops = true;            ///< samples are resolved only where models are
    bool depthFirst = true;       ///< in a pass before the shading one, where that saves time
    glm::vec4 background{0.0F, 0.0F, 0.0F, 1.0F};
    int backgroundTexture = -1, skyboxTexture = -1;  ///< indices into FramePlan::textures
};

struct FramePlan;

/// The depths of what a light sees.
struct ShadowMap {
    glm::dmat4 clip{1.0};  ///< clipFromLight
    std::vector<DrawItem>
        casters;  ///< in light space; drawn by their mesh, texture and place alone
    /// The frame that the light sees: the casters that are not seen through, made by composePasses.
    /// Its textures are indices into those of the plan that the map belongs to.
    std::shared_ptr<const FramePlan> frame;
};

struct FramePlan {
    ViewTransform view;
    std::vector<Pass> passes;  ///< in their order
    /// Where a frame of one pass draws: x, y, width, height; px from the lower left. Empty:
    /// anywhere.
    std::vector<glm::ivec4> covered;
    // Tables that the passes draw from.
    std::vector<DrawItem> items;
    Batches batches;  ///< of the items
    std::vector<LineVertex> lines;
    std::vector<std::vector<EyeLight>> lightSets;  ///< all empty where nothing is lit
    std::vector<ShadowMap> shadowMaps;
    std::vector<EyeShadowLight> shadowLights;  ///< lights refer to them
    int shadowSide = 0;                        ///< of each of them, texels
    glm::vec3 globalAmbient{1.0F};
    std::vector<TextureRef> textures;
    std::vector<image::Alpha> textureAlphas;  ///< of textures, once they are decoded; else empty
    // Reports: nothing of it is drawn.
    FrameStyle style;
    scene::Camera camera;
    Diagnostics findings;  ///< of the mesh files
    Stats stats;
};

}  // namespace farol::render
