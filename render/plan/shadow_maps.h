#pragma once

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

/// A map as shaders read it (std140). Map space: -1 to 1 across and up, and the distance along the
/// light; across and up are still to be divided by that in a perspective. Directional lights have
/// -1 to 1 there too, for depths from 1 to 0.
struct EyeShadowMap {
    glm::vec4 across, up, away;                 ///< rows of mapFromEye
    glm::vec4 planeAcross, planeUp, planeAway;  ///< rows of its inverse transpose, 3x3
    /// x: depth at distance 1 of a perspective, 0: directional; y: LightView::texel; z: depth of a
    /// unit of distance where it is directional.
    glm::vec4 facts;
};

EyeShadowMap eyeShadowMap(const LightView& light, const ViewTransform& view);

struct PlannedShadowMap {
    LightView light;
    std::vector<std::size_t> casters;  ///< indices into InstanceList::instances
};

struct PlannedShadows {
    struct Range {
        int first = 0, count = 0;  ///< of `maps`
    };
    std::vector<Range> ofLights;  ///< of InstanceList::lights
    std::vector<PlannedShadowMap> maps;
    int side = 0;  ///< of a map, texels

    /// Refers the lights of the list to their maps.
    void mark(std::vector<EyeLight>& lights) const;
};

/// Chooses the maps of a frame. Maps depend on the scene alone where that gives at least half of
/// the resolution of maps fitted to the view, so that they can be kept while a camera moves.
/// `isTransparent`: models with an opacity under 1 are seen through, and cast none. Warns of lights
/// for which no maps are left.
PlannedShadows planShadows(const InstanceList& list, const ViewTransform& view, double timeS,
                           bool isTransparent, const GlFacts& gl, Diagnostics& findings);

}  // namespace farol::render
