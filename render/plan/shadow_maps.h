#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "render/gl_facts.h"
#include "render/plan/camera.h"
#include "render/plan/eye_light.h"
#include "render/plan/instances.h"

/// Where the shadow maps of a frame lie, and which models each of them sees.
namespace farol::render {

/// Most maps of a frame; a light that shines to all sides needs up to six.
inline constexpr int kMaxShadowMaps = 64;
/// Most maps of a directional light.
inline constexpr int kMaxCascade = 4;

/// A light as a camera: light space has it at the origin, looking along -Z. Directional lights have
/// their origin in the middle of the scene.
struct LightView {
    glm::dmat3 rotation{1.0};  ///< lightFromWorld: right, up, backward
    glm::dvec3 origin{0.0};    ///< world space
    bool isPerspective = false;
    /// The part that the map covers: x and y in light space, divided by the distance along -Z where
    /// it is a perspective.
    glm::dvec2 min{0.0}, max{0.0};
    double nearest = 0.0, farthest = 0.0;  ///< along -Z; a perspective has no farthest
    double texel = 0.0;                    ///< size in light space, of a perspective at distance 1

    /// Reversed depth, for a clip volume of [0,1].
    glm::dmat4 clip() const;
};

struct PlannedShadowMap {
    LightView light;
    std::vector<std::size_t> casters;  ///< indices into InstanceList::instances
};

/// The maps of a light. A cube has the faces +X, -X, +Y, -Y, +Z, -Z of world space, a cascade its
/// maps from the finest to the coarsest, other lights the first alone.
struct PlannedShadowLight {
    glm::dmat3 rotation{1.0};  ///< that of its map, or of a cube
    bool isCube = false;
    std::array<int, 6> maps{-1, -1, -1, -1, -1, -1};  ///< of PlannedShadows::maps, -1: none
    bool isCascade() const { return !isCube && maps[1] >= 0; }
};

struct PlannedShadows {
    std::vector<int> ofLights;  ///< of InstanceList::lights: indices into `lights`, -1: none
    std::vector<PlannedShadowLight> lights;
    std::vector<PlannedShadowMap> maps;
    int side = 0;  ///< of a map, texels

    /// Refers the lights of the list to theirs.
    void mark(std::vector<EyeLight>& list) const;
};

/// What shaders know of a light's maps (std140). A place is turned into light space; in a cube into
/// that of its face; divided by the distance along the light in a perspective; scaled and moved to
/// -1..1.
struct EyeShadowLight {
    glm::vec4 right, up, back;  ///< rows of lightFromEye
    /// Perspective: x is the depth at distance 1. Directional: x is 0, the depth at distance d is
    /// y d + z.
    glm::vec4 facts;
    std::array<glm::vec4, 6> faces;   ///< scale and offset; scale 0: no map
    std::array<glm::vec4, 2> layers;  ///< of the faces
    std::array<glm::vec4, 2> depths;  ///< of a cascade: facts.yz of two maps each
};

EyeShadowLight eyeShadowLight(const PlannedShadows& shadows, const PlannedShadowLight& light,
                              const ViewTransform& view);

/// Chooses the maps of a frame. Maps depend on the scene alone where that gives at least half of
/// the resolution of maps fitted to the view, so that they can be kept while a camera moves.
/// `isTransparent`: models with an opacity under 1 are seen through, and cast none. Warns of lights
/// for which no maps are left.
PlannedShadows planShadows(const InstanceList& list, const ViewTransform& view, double timeS,
                           bool isTransparent, const GlFacts& gl, Diagnostics& findings);

}  // namespace farol::render
