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

constexpr double kTexelsPerPixel = 3.0;  // of the image's longer side
constexpr int kMinSide = 512, kMaxMapSide = 4096;
constexpr double kMaxTexels = 16 << 20;  // of all maps: 64 MiB
constexpr double kMargin = 4.0;          // texels round what casts, for the filter
/// Spots wider than this, degrees from their axis, have the maps of a point light.
constexpr double kWidestSpot = 60.0;

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
        out_.ofLights.resize(list_.lights.size());
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
        const std::vector<PlannedShadowMap> maps = mapsOf(list_.lights[index]);
        if (out_.maps.size() + maps.size() > static_cast<std::size_t>(kMaxShadowMaps)) {
            ++leftOut_;
            return;
        }
        out_.ofLights[index] = {static_cast<int>(out_.maps.size()), static_cast<int>(maps.size())};
        out_.maps.insert(out_.maps.end(), maps.begin(), maps.end());
    }

    /// Empty where nothing casts a shadow that could be seen.
    std::vector<PlannedShadowMap> mapsOf(const PlacedLight& placed) {
        const scene::Light& light = *placed.light;
        const bool isFixed = light.space == scene::LightSpace::camera;
        const glm::dmat3 worldFromEye = glm::transpose(view_.rotation);
        glm::dvec3 along = isFixed ? worldFromEye * placed.direction : placed.direction;
        const double length = glm::length(along);
        if (length > 0.0) along /= length;
        LightView seen;
        std::vector<PlannedShadowMap> maps;
        if (light.type == scene::LightType::directional) {
            if (length == 0.0) return maps;
            seen.rotation = rotationAlong(-along);
            seen.origin = 0.5 * (list_.bounds.min + list_.bounds.max);
            seen.min = glm::dvec2(-1e300);
            seen.max = glm::dvec2(1e300);
            casters_ = castersUnder(list_, boxes_, LightPlace{along, false});
            add(seen, maps);
            return maps;
        }
        seen.isPerspective = true;
        seen.origin = isFixed ? view_.eye + worldFromEye * placed.position : placed.position;
        // What a light at the eye leaves dark is what the eye does not see.
        if (glm::length(seen.origin - view_.eye) <= 1e-9 * radius_) return maps;
        casters_ = castersUnder(list_, boxes_, LightPlace{seen.origin, true});
        const bool isSpot = light.type == scene::LightType::spot && length > 0.0;
        if (isSpot && light.cutoffDeg <= kWidestSpot) {
            seen.rotation = rotationAlong(along);
            seen.max = glm::dvec2(std::tan(glm::radians(light.cutoffDeg)) * 1.02 + 1e-4);
            seen.min = -seen.max;
            add(seen, maps);
            return maps;
        }
        for (int face = 0; face < 6; ++face) {
            glm::dvec3 forward(0.0);
            forward[face / 2] = face % 2 ? -1.0 : 1.0;
            if (isSpot && light.cutoffDeg < 180.0 && isBesideFace(along, forward, light.cutoffDeg))
                continue;
            seen.rotation = rotationAlong(forward);
            // Beyond the face's edge by as much as its neighbour's filter reaches.
            seen.max = glm::dvec2(1.0 + 4.0 * kMargin / kMinSide);
            seen.min = -seen.max;
            add(seen, maps);
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

    /// Adds the map, cut to what casts and, where that is much less, to what is in view.
    void add(LightView light, std::vector<PlannedShadowMap>& maps) {
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
        if (map.casters.empty()) return;
        for (const CastingBox& box : boxes_) {
            if (!box.isThere) continue;
            const Bounds bounds = boundsOf(box.corners, light, reachesBehind);
            if (bounds.empty()) continue;
            receiving.add(bounds.min);
            receiving.add(bounds.max);
        }
        light.min = glm::max(light.min, glm::dvec2(glm::max(casting.min, receiving.min)));
        light.max = glm::min(light.max, glm::dvec2(glm::min(casting.max, receiving.max)));
        if (light.min.x > light.max.x || light.min.y > light.max.y) return;
        cutToView(light);
        if (light.min.x > light.max.x || light.min.y > light.max.y) return;
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
        if (kept == 0) return;
        if (light.isPerspective) {
            light.nearest = std::max(0.5 * light.nearest, 1e-5 * radius_);
        } else {
            const double slack = 1e-3 * (light.farthest - light.nearest) + 1e-6 * radius_;
            light.nearest -= slack;
            light.farthest += slack;
        }
        map.light = light;
        maps.push_back(std::move(map));
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

EyeShadowMap eyeShadowMap(const LightView& light, const ViewTransform& view) {
    const glm::dmat3 lightFromEye = light.rotation * glm::transpose(view.rotation);
    const glm::dvec3 offset = light.rotation * (view.eye - light.origin);
    const auto rowOf = [&](int i) {
        return glm::dvec4(lightFromEye[0][i], lightFromEye[1][i], lightFromEye[2][i], offset[i]);
    };
    const glm::dvec2 middle = 0.5 * (light.min + light.max), half = 0.5 * (light.max - light.min);
    glm::dvec4 away = -rowOf(2);
    std::array<glm::dvec4, 3> rows;
    if (light.isPerspective) {
        rows = {(rowOf(0) - middle.x * away) / half.x, (rowOf(1) - middle.y * away) / half.y, away};
    } else {
        rows = {rowOf(0) / half.x, rowOf(1) / half.y,
                away * (2.0 / (light.farthest - light.nearest))};
        rows[0].w -= middle.x / half.x;
        rows[1].w -= middle.y / half.y;
        rows[2].w -= (light.farthest + light.nearest) / (light.farthest - light.nearest);
    }
    const glm::dmat3 columns{glm::dvec3(rows[0]), glm::dvec3(rows[1]), glm::dvec3(rows[2])};
    // The matrix has these as rows; its inverse transpose has those of the inverse's transpose.
    const glm::dmat3 plane = glm::inverse(columns);  // of the transpose: columns are its rows' ends
    const auto planeRow = [&](int i) {
        return glm::vec4(glm::dvec4(plane[0][i], plane[1][i], plane[2][i], 0.0));
    };
    EyeShadowMap map{};
    map.across = glm::vec4(rows[0]);
    map.up = glm::vec4(rows[1]);
    map.away = glm::vec4(rows[2]);
    map.planeAcross = planeRow(0);
    map.planeUp = planeRow(1);
    map.planeAway = planeRow(2);
    const double depthOfUnit = light.isPerspective ? 0.0 : 1.0 / (light.farthest - light.nearest);
    map.facts = glm::vec4(light.isPerspective ? light.nearest : 0.0, light.texel, depthOfUnit, 0.0);
    return map;
}

void PlannedShadows::mark(std::vector<EyeLight>& lights) const {
    for (std::size_t i = 0; i < ofLights.size(); ++i) {
        lights[i].diffuse.w = static_cast<float>(ofLights[i].count);
        lights[i].ambient.w = static_cast<float>(ofLights[i].first);
    }
}

PlannedShadows planShadows(const InstanceList& list, const ViewTransform& view, double timeS,
                           bool isTransparent, const GlFacts& gl, Diagnostics& findings) {
    return ShadowPlanner(list, view, timeS, isTransparent, gl).run(findings);
}

}  // namespace farol::render
