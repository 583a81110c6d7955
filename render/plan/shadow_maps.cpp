#include "render/plan/shadow_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "render/plan/light_bounds.h"
#include "render/plan/messages.h"
#include "render/plan/shadow_bounds.h"
#include "render/plan/shadow_splits.h"
#include "scene/animation.h"

namespace farol::render {
namespace {

constexpr double kTexelsPerPixel = 4.0;  // of the image's longer side
constexpr int kMinSide = 512, kMaxMapSide = 4096;
constexpr double kMaxTexels = 16 << 20;  // of all maps: 64 MiB
constexpr double kMargin = 4.0;          // texels round what casts, for the filter
/// Spots of a larger cutoff have the maps of a point light.
constexpr double kMaxSpotCutoffDeg = 60.0;
/// Lights farther from the scene's middle than so many of its radii see all of it in one map.
constexpr double kOutside = 1.5;
/// Lights farther from what is in view than so many of its radii: their rays are parallel within
/// half a texel, and depths along a perspective would be rounded more than that.
constexpr double kParallel = 4096.0;
/// Lights farther from it than so many have it on one side.
constexpr double kOneSide = 4.0;
/// Depths of a map reach no farther than so many times its extent, where the view allows it: their
/// rounding is 2e-6 of the range.
constexpr double kDeepest = 256.0;
/// Directional lights whose texels cover more pixels than so many have several maps: up to there
/// the filter blurs an edge by two pixels or less to either side.
constexpr double kCoarse = 1.5;
/// A map farther from its origin than so many of its extents has another.
constexpr double kFarOff = 64.0;
/// One farther than so many is looked at again as those that are too coarse.
constexpr double kAside = 8.0;

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
        if (!out_.maps.empty()) {
            split();
            fit();
        }
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
        if (!maps[0].light.isPerspective) parallels_.push_back({out_.lights.size(), casters_});
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
            casters_ = castersUnder(list_, boxes_, LightPlace{along, false});
            addParallel(along, middle, nullptr, maps, out);
            return maps;
        }
        seen.isPerspective = true;
        seen.origin = isFixed ? view_.eye + worldFromEye * placed.position : placed.position;
        // What a light at the eye leaves dark is what the eye does not see.
        const double atEye = std::min(1e-9 * radius_, 1e-6 * view_.near);
        if (glm::length(seen.origin - view_.eye) <= std::max(atEye, 1e-15 * glm::length(view_.eye)))
            return maps;
        casters_ = castersUnder(list_, boxes_, LightPlace{seen.origin, true});
        if (const std::optional<Beam> beam = beamFrom(seen.origin)) {
            addParallel(beam->towards, beam->middle, &beam->length, maps, out);
            return maps;
        }
        const bool isSpot =
            light.type == scene::LightType::spot && length > 0.0 && light.cutoffDeg < 180.0;
        const double distance = glm::length(middle - seen.origin);
        if ((isSpot && light.cutoffDeg <= kMaxSpotCutoffDeg) || distance > kOutside * radius_) {
            // From afar all of the scene is within a cone, too.
            const bool isNarrow = isSpot && light.cutoffDeg <= kMaxSpotCutoffDeg;
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

    /// World space.
    struct Part {
        glm::dvec3 middle{0.0};
        double radius = 0.0;  ///< 0: nothing
    };

    Part partInView() {
        Box box;
        for (const glm::dvec3& corner : visible()) box.add(corner);
        if (box.empty()) return {};
        return {0.5 * (box.min + box.max), 0.5 * glm::length(box.max - box.min)};
    }

    /// From what is in view to a light, world space.
    struct Beam {
        glm::dvec3 middle{0.0}, towards{0.0};
        double length = 0.0;
    };

    /// The light's rays, where they are as good as parallel: the light is far from what is in view,
    /// and so is each caster before it, or none stands between the two.
    std::optional<Beam> beamFrom(const glm::dvec3& light) {
        const Part part = partInView();
        Beam beam{part.middle};
        beam.length = glm::length(light - beam.middle);
        if (!(part.radius > 0.0) || beam.length <= kParallel * part.radius) return std::nullopt;
        beam.towards = (light - beam.middle) / beam.length;
        // Up to there parallel rays are off by less than half a texel, or than depths are.
        const double straight =
            std::max(beam.length / kParallel, 1e-6 * beam.length * (beam.length / part.radius));
        for (const std::size_t i : casters_) {
            const auto& corners = boxes_[i].corners;
            const double size = glm::length(corners[7] - corners[0]);
            const double away = distanceTo(boxes_[i], beam.middle);
            if (away + size <= straight || away > 0.5 * beam.length) continue;
            const glm::dvec3 place = 0.5 * (corners[0] + corners[7]) - beam.middle;
            const double beside = glm::length(place - glm::dot(place, beam.towards) * beam.towards);
            if (beside <= 0.5 * size + part.radius) return std::nullopt;
        }
        return beam;
    }

    /// `towards`: the light, a unit vector. `length`: of its beam; casters in the farther half, and
    /// round the light, are left out.
    void addParallel(const glm::dvec3& towards, const glm::dvec3& middle, const double* length,
                     std::vector<PlannedShadowMap>& maps, PlannedShadowLight& out) {
        LightView seen;
        seen.rotation = out.rotation = rotationAlong(-towards);
        seen.origin = middle;
        seen.min = glm::dvec2(-1e300);
        seen.max = glm::dvec2(1e300);
        if (length != nullptr)
            casters_.erase(std::remove_if(casters_.begin(), casters_.end(),
                                          [&](std::size_t i) {
                                              return distanceTo(boxes_[i], middle) > 0.5 * *length;
                                          }),
                           casters_.end());
        if (add(seen, maps)) out.maps[0] = 0;
    }

    /// From a place to the box along the axes round the casting one; 0 within it.
    static double distanceTo(const CastingBox& casting, const glm::dvec3& place) {
        Box box;
        for (const glm::dvec3& corner : casting.corners) box.add(corner);
        return glm::length(glm::max(glm::max(box.min - place, place - box.max), 0.0));
    }

    /// True if a cone has nothing of the face of a cube, whose corners are 54.8 degrees from its
    /// axis.
    static bool isBesideFace(const glm::dvec3& along, const glm::dvec3& forward, double cutoffDeg) {
        const double angle = std::acos(std::clamp(glm::dot(along, forward), -1.0, 1.0));
        return angle > glm::radians(cutoffDeg + 55.5);
    }

    /// Adds the map, cut to what casts and, where that is much less, to what is in view. Returns
    /// false where nothing is left.
    bool add(LightView light, std::vector<PlannedShadowMap>& maps) {
        PlannedShadowMap map;
        LightBounds casting, receiving;
        std::vector<LightBounds> each;
        bool reachesBehind = false;
        for (const std::size_t i : casters_) {
            const LightBounds bounds = boundsOf(boxes_[i].corners, light, reachesBehind);
            if (bounds.empty()) continue;
            map.casters.push_back(i);
            each.push_back(bounds);
            casting.add(bounds.min);
            casting.add(bounds.max);
        }
        if (map.casters.empty()) return false;
        for (const CastingBox& box : boxes_) {
            if (!box.isThere) continue;
            const LightBounds bounds = boundsOf(box.corners, light, reachesBehind);
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
            const LightBounds& bounds = each[k];
            if (bounds.min.x > light.max.x || bounds.max.x < light.min.x ||
                bounds.min.y > light.max.y || bounds.max.y < light.min.y)
                continue;
            light.nearest = std::min(light.nearest, bounds.min.z);
            map.casters[kept++] = map.casters[k];
        }
        map.casters.resize(kept);
        if (kept == 0) return false;
        if (light.isPerspective) {
            light.nearest = std::max(0.5 * light.nearest, leastDistance(map.casters, light.origin));
        } else {
            cutDepth(light);
            const double range = light.farthest - light.nearest;
            const double slack =
                1e-3 * range + 1e-6 * std::min(radius_, 1e3 * range + extent(light));
            light.nearest -= slack;
            light.farthest += slack;
            recenter(light);
        }
        map.light = light;
        maps.push_back(std::move(map));
        return true;
    }

    static double extent(const LightView& light) {
        return std::max(light.max.x - light.min.x, light.max.y - light.min.y);
    }

    /// Corners of the part of the scene's box that is in view.
    const std::vector<glm::dvec3>& seen() {
        if (!seen_) {
            std::array<glm::dvec3, 8> corners;
            const Box& box = list_.bounds;
            for (std::size_t i = 0; i < corners.size(); ++i)
                corners[i] = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                              i & 4 ? box.max.z : box.min.z};
            seen_ = visibleCorners(corners, view_);
        }
        return *seen_;
    }

    /// The same box by box: models far off do not count.
    const std::vector<glm::dvec3>& visible() {
        if (!visible_) visible_ = visibleCorners(boxes_, view_);
        return *visible_;
    }

    /// The nearest place of a perspective, where casters reach nearer: as far as what is there asks
    /// for, so that a model far off does not push it away from those at hand.
    double leastDistance(const std::vector<std::size_t>& casters, const glm::dvec3& light) const {
        double least = 1e-5 * radius_;
        for (const std::size_t i : casters) {
            const auto& corners = boxes_[i].corners;
            least = std::min(least, std::max(0.25 * distanceTo(boxes_[i], light),
                                             1e-3 * glm::length(corners[7] - corners[0])));
        }
        return std::max(least, 1e-300);
    }

    /// Where a map's depths reach too far for its extent, they are those of what is in view.
    /// Casters before them are clamped to the nearest.
    void cutDepth(LightView& light) {
        if (light.farthest - light.nearest <= kDeepest * extent(light)) return;
        double nearest = 1e300, farthest = -1e300;
        for (const glm::dvec3& corner : visible()) {
            const double along = -(light.rotation * (corner - light.origin)).z;
            nearest = std::min(nearest, along);
            farthest = std::max(farthest, along);
        }
        nearest = std::max(nearest, light.nearest);
        farthest = std::min(farthest, light.farthest);
        if (nearest > farthest) return;
        light.nearest = nearest;
        light.farthest = farthest;
    }

    /// Of a parallel map, and of its middle from its origin.
    static double sizeOf(const LightView& light) {
        return extent(light) + light.farthest - light.nearest;
    }
    static double distanceOf(const LightView& light) {
        return glm::length(
            glm::dvec3(0.5 * (light.min + light.max), 0.5 * (light.nearest + light.farthest)));
    }

    /// Floats hold places in the map only near its origin.
    static void recenter(LightView& light) {
        if (distanceOf(light) <= kFarOff * sizeOf(light)) return;
        const glm::dvec2 middle = 0.5 * (light.min + light.max);
        const double away = 0.5 * (light.nearest + light.farthest);
        light.origin += glm::transpose(light.rotation) * glm::dvec3(middle, -away);
        light.min -= middle;
        light.max -= middle;
        light.nearest -= away;
        light.farthest -= away;
    }

    void cutToView(LightView& light) {
        LightBounds part;
        if (!addInFront(light, seen(), part)) {
            // Of a scene all round a light that is far from what is in view, one side alone is
            // seen.
            const Part lit = partInView();
            if (glm::length(lit.middle - light.origin) <= kOneSide * lit.radius) return;
            part = {};
            if (!addInFront(light, visible(), part) && !part.empty()) return;
        }
        if (part.empty()) {
            light.max = light.min - 1.0;  // nothing is in view
            return;
        }
        const auto ofLight = [&light](const LightBounds& bounds) {
            return std::pair(glm::max(light.min, glm::dvec2(bounds.min)),
                             glm::min(light.max, glm::dvec2(bounds.max)));
        };
        const auto [min, max] = ofLight(part);
        const glm::dvec2 whole = light.max - light.min, size = max - min;
        if (size.x >= 0.5 * whole.x && size.y >= 0.5 * whole.y) return;
        LightBounds models;
        if (!addInFront(light, visible(), models) || models.empty()) models = part;
        std::tie(light.min, light.max) = ofLight(models);
    }

    /// Of each of so many maps, texels.
    int sideOf(int maps) const {
        const int longer = std::max(view_.size.x, view_.size.y);
        const double share = std::sqrt(kMaxTexels / static_cast<double>(maps));
        const double wanted =
            std::clamp(kTexelsPerPixel * longer, double{kMinSide}, double{kMaxMapSide});
        const double side = std::min({wanted, share, static_cast<double>(gl_.maxTargetSide)});
        return std::max(64, static_cast<int>(side) / 64 * 64);
    }

    /// Replaces parallel maps that are coarser than pixels, or whose depths are rounded as
    /// coarsely, by those of parts of the view.
    void split() {
        const auto usableSide = [this](int maps) {
            return sideOf(maps) - static_cast<int>(2.0 * kMargin);
        };
        const auto count = static_cast<int>(out_.maps.size());
        std::vector<WideLight> wide;
        std::vector<PlannedShadowLight*> lights;
        for (const Parallel& parallel : parallels_) {
            PlannedShadowLight& light = out_.lights[parallel.light];
            const LightView& map = out_.maps[static_cast<std::size_t>(light.maps[0])].light;
            const double texel = extent(map) / usableSide(count);
            const bool isRough = map.farthest - map.nearest > kDeepest * extent(map) ||
                                 distanceOf(map) > kAside * sizeOf(map);
            if (!isRough && !mayBeCoarse(boxes_, view_, texel)) continue;
            LitDepths depths(list_, boxes_, view_, map);
            const double pixels = std::max(depths.pixelsOf(texel), isRough ? 2.0 : 0.0);
            if (pixels <= kCoarse) continue;
            wide.push_back({std::move(depths), pixels, parallel.casters});
            lights.push_back(&light);
        }
        if (wide.empty()) return;
        const auto split = splitMaps(wide, boxes_, count, usableSide);
        for (std::size_t i = 0; i < split.size(); ++i)
            for (std::size_t k = 0; k < split[i].size(); ++k) {
                int& map = lights[i]->maps[k];
                if (k > 0) map = static_cast<int>(out_.maps.size());
                if (k > 0) out_.maps.emplace_back();
                out_.maps[static_cast<std::size_t>(map)] = split[i][k];
                lights[i]->rotation = split[i][k].light.rotation;
            }
    }

    /// The size of the maps, and of their texels.
    void fit() {
        out_.side = sideOf(static_cast<int>(out_.maps.size()));
        for (PlannedShadowMap& map : out_.maps) {
            LightView& light = map.light;
            const glm::dvec2 middle = 0.5 * (light.min + light.max);
            glm::dvec2 half = 0.5 * (light.max - light.min);
            // A model seen edge-on has an extent too.
            const double most = std::max(half.x, half.y);
            const double scale = light.isPerspective ? 1.0
                                 : most > 0.0        ? std::min(radius_, 1e3 * most)
                                                     : light.farthest - light.nearest;
            half = glm::max(half, glm::dvec2(1e-3 * most + 1e-6 * scale));
            half *= out_.side / (out_.side - 2.0 * kMargin);
            light.min = middle - half;
            light.max = middle + half;
            light.texel = 2.0 * std::max(half.x, half.y) / out_.side;
        }
    }

    struct Parallel {
        std::size_t light;                 ///< of PlannedShadows::lights
        std::vector<std::size_t> casters;  ///< that may be in its maps
    };

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
    std::vector<Parallel> parallels_;
    std::optional<std::vector<glm::dvec3>> seen_, visible_;
};

}  // namespace

PlannedShadows planShadows(const InstanceList& list, const ViewTransform& view, double timeS,
                           bool isTransparent, const GlFacts& gl, Diagnostics& findings) {
    return ShadowPlanner(list, view, timeS, isTransparent, gl).run(findings);
}

}  // namespace farol::render
