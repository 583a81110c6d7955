#include "scene/loop.h"

#include <cmath>
#include <cstdint>
#include <numeric>
#include <variant>

#include "scene/animation.h"

namespace farol::scene {
namespace {

/// The common multiple so far in ms: 1 when nothing moves, 0 when it is too long.
class Loop {
  public:
    void add(double seconds) {
        const double ms = std::abs(seconds) * 1000.0;
        if (loopMs_ == 0) return;
        if (!(ms >= 0.5) || ms > kMaxLoopSeconds * 1000.0) {
            loopMs_ = 0;
            return;
        }
        loopMs_ = std::lcm(loopMs_, static_cast<std::int64_t>(std::llround(ms)));
        if (static_cast<double>(loopMs_) > kMaxLoopSeconds * 1000.0) loopMs_ = 0;
        moves_ = true;
    }
    void add(const Color& color) {
        if (color.cycles) add(kHueSeconds);
    }
    void add(const Light& light) {
        add(light.diffuse);
        add(light.ambient);
        add(light.specular);
    }
    void add(const Group& group) {
        for (const Transform& transform : group.transforms) {
            if (const auto* curve = std::get_if<FollowCurve>(&transform)) add(curve->seconds);
            if (const auto* spin = std::get_if<Spin>(&transform)) add(spin->seconds);
        }
        for (const Light& light : group.lights) add(light);
        for (const Model& model : group.models) {
            if (!model.material) continue;
            add(model.material->diffuse);
            add(model.material->ambient);
            add(model.material->specular);
            add(model.material->emissive);
        }
        for (const Group& child : group.groups) add(child);
    }
    void add(const Scene& scene) {
        for (const Light& light : scene.lights) add(light);
        for (const Group& group : scene.groups) add(group);
        if (scene.entity) add(*scene.entity);
    }
    std::optional<double> seconds() const {
        if (!moves_ || loopMs_ == 0) return std::nullopt;
        return static_cast<double>(loopMs_) / 1000.0;
    }

  private:
    std::int64_t loopMs_ = 1;
    bool moves_ = false;
};

}  // namespace

std::optional<double> loopSeconds(const Scene& scene) {
    Loop loop;
    loop.add(scene);
    return loop.seconds();
}

}  // namespace farol::scene
