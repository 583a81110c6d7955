#include "render/plan/shadow_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "render/plan/messages.h"
#include "render/plan/shadow_bounds.h"
#include "scene/animation.h"

namespace farol::render {
namespace {

constexpr double kTexelsPerPixel = 4.0;  // of the image's longer side
constexpr int kMinSide = 512, kMaxMapSide = 4096;
constexpr double kMaxTexels = 16 << 20;  // of all maps: 64 MiB
constexpr double kMargin = 4.0;          // texels round what casts, for the filter
/// Spots wider than this, degrees from their axis, have the maps of a point light.
constexpr double kWidestSpot = 60.0;
/// Lights farther from the scene's middle than so many of its radii see all of it in one map.
constexpr double kFar = 1.5;

struct Bounds {
    glm::dvec3 min{1e300}, max{-1e300};
    bool empty() const { return min.x > max.x; }
    void add(const glm::dvec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
};

/// A place in light space as LightView::min and max have it, and its distance along the light.
glm::dvec3 project(const glm::dvec3& light, bool isPerspective) {
    const double away = -light.z;
    return isPerspective ? glm::dvec3(light.x / away, light.y / away, away)
                         : glm::dvec3(light.x, light.y, away);
}

glm::dmat3 rotationAlong(const glm::dvec3& forward) {
    // Across is level where it can be: a ground is then as short in the map as the light is low.
    glm::dvec3 up(0.0, 1.0, 0.0);
    if (std::abs(forward.y) > 0.9999) up = glm::dvec3(0.0, 0.0, -1.0);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    return glm::transpose(glm::dmat3(right, glm::cross(right, forward), -forward));
}

bool isBlack(const scene::Light& light, double timeS) {
    return scene::colorAt(light.diffuse, timeS) == glm::vec3(0.0F) &&
           scene::colorAt(light.specular, timeS) == glm::vec3(0.0F);
}

class ShadowPlanner {
  public:
    ShadowPlanner(const InstanceList& list, const ViewTransform& view, double timeS,
                  bool isTransparent, const GlFacts& gl)
        : list_(list), view_(view), timeS_(timeS), isTransparent_(isTransparent), gl_(gl) {}

    PlannedShadows run(Diagnostics& findings) {
        out_.ofLights.assign(list_.lights.size(), -1);
        if (list_.bounds.empty()) return std::move(out_);
        radius_ = 0.5 * glm::length(list_.bounds.max - list_.bounds.min);
        boxes_ = castingBoxes(list_, isTransparent_);
        std::vector<bool> used(list_.lights.size(), false);
        for (const Instance& instance : list_.instances)
            for (const int light : list_.lightSets[static_cast<std::size_t>(instance.lightSet)])
                used[static_cast<std::size_t>(light)] = true;
        for (std::size_t i = 0; i < used.size(); ++i)
            if (used[i] && !isBlack(*list_.lights[i].light, timeS_)) addLight(i);
        if (!out_.maps.empty()) fit();
        if (leftOut_ > 0)
            findings.push_back(diagnosticOf(
                Severity::warning,
                message<"limit.shadows">("count"_arg = leftOut_, "max"_arg = kMaxShadowMaps), {}));
        return std::move(out_);
    }

  private:
    void addLight(std::size_t index) {
        PlannedShadowLight light;
        std::vector<PlannedShadowMap> maps = mapsOf(list_.lights[index], light);
        if (maps.empty()) return;
        if (out_.maps.size() + maps.size() > static_cast<std::size_t>(kMaxShadowMaps)) {
            ++leftOut_;
            return;
        }
        double nearest = 1e300;  // one for all faces
        for (const PlannedShadowMap& map : maps) nearest = std::min(nearest, map.light.nearest);
        for (PlannedShadowMap& map : maps) map.light.nearest = nearest;
        for (int& map : light.maps)
            if (map >= 0) map += static_cast<int>(out_.maps.size());
        out_.ofLights[index] = static_cast<int>(out_.lights.size());
        out_.lights.push_back(light);
        out_.maps.insert(out_.maps.end(), maps.begin(), maps.end());
    }

    /// Empty where nothing casts a shadow that could be seen.
    std::vector<PlannedShadowMap> mapsOf(const PlacedLight& placed, PlannedShadowLight& out) {
        const scene::Light& light = *placed.light;
        const bool isFixed = light.space == scene::LightSpace::camera;
        const glm::dmat3 worldFromEye = glm::transpose(view_.rotation);
        glm::dvec3 along = isFixed ? worldFromEye * placed.direction : placed.direction;
        const double length = glm::length(along);
        if (length > 0.0) along /= length;
        const glm::dvec3 middle = 0.5 * (list_.bounds.min + list_.bounds.max);
        LightView seen;
        std::vector<PlannedShadowMap> maps;
        if (light.type == scene::LightType::directional) {
            if (length == 0.0) return maps;
            seen.rotation = out.rotation = rotationAlong(-along);
            seen.origin = middle;
            seen.min = glm::dvec2(-1e300);
            seen.max = glm::dvec2(1e300);
            casters_ = castersUnder(list_, boxes_, LightPlace{along, false});
            if (add(seen, maps)) out.maps[0] = 0;
            return maps;
        }
        seen.isPerspective = true;
        seen.origin = isFixed ? view_.eye + worldFromEye * placed.position : placed.position;
        // What a light at the eye leaves dark is what the eye does not see.
        if (glm::length(seen.origin - view_.eye) <= 1e-9 * radius_) return maps;
        casters_ = castersUnder(list_, boxes_, LightPlace{seen.origin, true});
        const bool isSpot =
            light.type == scene::LightType::spot && length > 0.0 && light.cutoffDeg < 180.0;
        const double distance = glm::length(middle - seen.origin);
        if ((isSpot && light.cutoffDeg <= kWidestSpot) || distance > kFar * radius_) {
            // From afar all of the scene is within a cone, too.
            const bool isNarrow = isSpot && light.cutoffDeg <= kWidestSpot;
            seen.rotation = out.rotation =
                rotationAlong(isNarrow ? along : (middle - seen.origin) / distance);
            const double tangent =
                isNarrow ? std::tan(glm::radians(light.cutoffDeg)) * 1.02 + 1e-4
                         : radius_ / std::sqrt(distance * distance - radius_ * radius_);
            seen.max = glm::dvec2(tangent);
            seen.min = -seen.max;
            if (add(seen, maps)) out.maps[0] = 0;
            return maps;
        }
        out.isCube = true;
        for (std::size_t face = 0; face < 6; ++face) {
            glm::dvec3 forward(0.0);
            forward[static_cast<int>(face / 2)] = face % 2 ? -1.0 : 1.0;
            if (isSpot && isBesideFace(along, forward, light.cutoffDeg)) continue;
            seen.rotation = rotationAlong(forward);
            // Beyond the face's edge by more than the filter reaches.
            seen.max = glm::dvec2(1.0 + 4.0 * kMargin / kMinSide);
            seen.min = -seen.max;
            if (add(seen, maps)) out.maps[face] = static_cast<int>(maps.size()) - 1;
        }
        return maps;
    }

    /// True if a cone has nothing of the face of a cube, whose corners are 54.8 degrees from its
    /// axis.
    static bool isBesideFace(const glm::dvec3& along, const glm::dvec3& forward, double cutoffDeg) {
        const double angle = std::acos(std::clamp(glm::dot(along, forward), -1.0, 1.0));
        return angle > glm::radians(cutoffDeg + 55.5);
    }

    /// Where a box lies in the map; `reachesBehind`: a perspective has no bounds for it.
    static Bounds boundsOf(const std::array<glm::dvec3, 8>& corners, const LightView& light,
                           bool& reachesBehind) {
        Bounds bounds;
        bool isAnyBefore = false;
        reachesBehind = false;
        for (const glm::dvec3& corner : corners) {
            const glm::dvec3 at = light.rotation * (corner - light.origin);
            if (light.isPerspective && -at.z <= 1e-6 * glm::length(at)) {
                reachesBehind = true;
                continue;
            }
            isAnyBefore = true;
            bounds.add(project(at, light.isPerspective));
        }
        if (!isAnyBefore) return {};  // wholly behind
        if (reachesBehind) {
            bounds.min = glm::dvec3(-1e300, -1e300, 0.0);
            bounds.max = glm::dvec3(1e300, 1e300, bounds.max.z);
        }
        return bounds;
    }

    /// Adds the map, cut to what casts and, where that is much less, to what is in view. Returns
    /// false where nothing is left.
    bool add(LightView light, std::vector<PlannedShadowMap>& maps) {
        PlannedShadowMap map;
        Bounds casting, receiving;
        std::vector<Bounds> each;
        bool reachesBehind = false;
        for (const std::size_t i : casters_) {
            const Bounds bounds = boundsOf(boxes_[i].corners, light, reachesBehind);
            if (bounds.empty()) continue;
            map.casters.push_back(i);
            each.push_back(bounds);
            casting.add(bounds.min);
            casting.add(bounds.max);
        }
        if (map.casters.empty()) return false;
        for (const CastingBox& box : boxes_) {
            if (!box.isThere) continue;
            const Bounds bounds = boundsOf(box.corners, light, reachesBehind);
            if (bounds.empty()) continue;
            receiving.add(bounds.min);
            receiving.add(bounds.max);
        }
        light.min = glm::max(light.min, glm::dvec2(glm::max(casting.min, receiving.min)));
        light.max = glm::min(light.max, glm::dvec2(glm::min(casting.max, receiving.max)));
        if (light.min.x > light.max.x || light.min.y > light.max.y) return false;
        cutToView(light);
        if (light.min.x > light.max.x || light.min.y > light.max.y) return false;
        light.nearest = 1e300;
        light.farthest = receiving.max.z;
        std::size_t kept = 0;
        for (std::size_t k = 0; k < each.size(); ++k) {
            const Bounds& bounds = each[k];
            if (bounds.min.x > light.max.x || bounds.max.x < light.min.x ||
                bounds.min.y > light.max.y || bounds.max.y < light.min.y)
                continue;
            light.nearest = std::min(light.nearest, bounds.min.z);
            map.casters[kept++] = map.casters[k];
        }
        map.casters.resize(kept);
        if (kept == 0) return false;
        if (light.isPerspective) {
            light.nearest = std::max(0.5 * light.nearest, 1e-5 * radius_);
        } else {
            const double slack = 1e-3 * (light.farthest - light.nearest) + 1e-6 * radius_;
            light.nearest -= slack;
            light.farthest += slack;
        }
        map.light = light;
        maps.push_back(std::move(map));
        return true;
    }

    void cutToView(LightView& light) {
        if (seen_.empty()) seen_ = visibleCorners(list_.bounds, view_);
        Bounds visible;
        for (const glm::dvec3& corner : seen_) {
            const glm::dvec3 at = light.rotation * (corner - light.origin);
            if (light.isPerspective && -at.z <= 1e-3 * glm::length(at)) return;
            visible.add(project(at, light.isPerspective));
        }
        if (visible.empty()) {
            light.max = light.min - 1.0;  // nothing is in view
            return;
        }
        const glm::dvec2 min = glm::max(light.min, glm::dvec2(visible.min));
        const glm::dvec2 max = glm::min(light.max, glm::dvec2(visible.max));
        const glm::dvec2 whole = light.max - light.min, part = max - min;
        if (part.x >= 0.5 * whole.x && part.y >= 0.5 * whole.y) return;
        light.min = min;
        light.max = max;
    }

    /// The size of the maps, and of their texels.
    void fit() {
        const int longer = std::max(view_.size.x, view_.size.y);
        const double most = std::sqrt(kMaxTexels / static_cast<double>(out_.maps.size()));
        const double wanted =
            std::clamp(kTexelsPerPixel * longer, double{kMinSide}, double{kMaxMapSide});
        const double side = std::min({wanted, most, static_cast<double>(gl_.maxTargetSide)});
        out_.side = std::max(64, static_cast<int>(side) / 64 * 64);
        for (PlannedShadowMap& map : out_.maps) {
            LightView& light = map.light;
            const glm::dvec2 middle = 0.5 * (light.min + light.max);
            glm::dvec2 half = 0.5 * (light.max - light.min);
            // A model seen edge-on has an extent too.
            half = glm::max(half, glm::dvec2(1e-3 * std::max(half.x, half.y) +
                                             1e-6 * (light.isPerspective ? 1.0 : radius_)));
            half *= out_.side / (out_.side - 2.0 * kMargin);
            light.min = middle - half;
            light.max = middle + half;
            light.texel = 2.0 * std::max(half.x, half.y) / out_.side;
        }
    }

    const InstanceList& list_;
    const ViewTransform& view_;
    double timeS_;
    bool isTransparent_;
    const GlFacts& gl_;
    PlannedShadows out_;
    double radius_ = 1.0;
    int leftOut_ = 0;                   ///< lights for which no maps are left
    std::vector<CastingBox> boxes_;     ///< of the instances
    std::vector<std::size_t> casters_;  ///< of the light at hand
    std::vector<glm::dvec3> seen_;      ///< corners of the part of the scene that is in view
};

}  // namespace

glm::dmat4 LightView::clip() const {
    const glm::dvec2 middle = 0.5 * (min + max), half = 0.5 * (max - min);
    glm::dmat4 clip(0.0);
    clip[0][0] = 1.0 / half.x;
    clip[1][1] = 1.0 / half.y;
    if (isPerspective) {
        clip[2][0] = middle.x / half.x;
        clip[2][1] = middle.y / half.y;
        clip[2][3] = -1.0;
        clip[3][2] = nearest;
        return clip;
    }
    clip[3][0] = -middle.x / half.x;
    clip[3][1] = -middle.y / half.y;
    clip[2][2] = 1.0 / (farthest - nearest);
    clip[3][2] = farthest / (farthest - nearest);
    clip[3][3] = 1.0;
    return clip;
}

EyeShadowLight eyeShadowLight(const PlannedShadows& shadows, const PlannedShadowLight& light,
                              const ViewTransform& view) {
    EyeShadowLight out{};
    std::array<float, 8> layers{};
    const LightView* first = nullptr;
    for (std::size_t face = 0; face < 6; ++face) {
        out.faces[face] = glm::vec4(0.0F, 0.0F, 2.0F, 2.0F);
        if (light.maps[face] < 0) continue;
        const LightView& map = shadows.maps[static_cast<std::size_t>(light.maps[face])].light;
        if (first == nullptr) first = &map;
        const glm::dvec2 middle = 0.5 * (map.min + map.max), half = 0.5 * (map.max - map.min);
        out.faces[face] = glm::vec4(glm::dvec4(1.0 / half, -middle / half));
        layers[face] = static_cast<float>(light.maps[face]);
    }
    out.layers = {glm::vec4(layers[0], layers[1], layers[2], layers[3]),
                  glm::vec4(layers[4], layers[5], 0.0F, 0.0F)};
    if (first == nullptr) return out;
    const glm::dmat3 turn = light.rotation * glm::transpose(view.rotation);
    const glm::dvec3 offset = light.rotation * (view.eye - first->origin);
    const auto row = [&](int i) {
        return glm::vec4(glm::dvec4(turn[0][i], turn[1][i], turn[2][i], offset[i]));
    };
    out.right = row(0);
    out.up = row(1);
    out.back = row(2);
    const double range = first->farthest - first->nearest;
    out.facts = first->isPerspective ? glm::vec4(first->nearest, 0.0, 0.0, 0.0)
                                     : glm::vec4(0.0, -1.0 / range, first->farthest / range, 0.0);
    return out;
}

void PlannedShadows::mark(std::vector<EyeLight>& list) const {
    for (std::size_t i = 0; i < ofLights.size(); ++i) {
        if (ofLights[i] < 0) continue;
        const PlannedShadowLight& light = lights[static_cast<std::size_t>(ofLights[i])];
        list[i].diffuse.w = light.isCube ? 2.0F : 1.0F;
        list[i].ambient.w = static_cast<float>(ofLights[i]);
    }
}

PlannedShadows planShadows(const InstanceList& list, const ViewTransform& view, double timeS,
                           bool isTransparent, const GlFacts& gl, Diagnostics& findings) {
    return ShadowPlanner(list, view, timeS, isTransparent, gl).run(findings);
}

}  // namespace farol::render
