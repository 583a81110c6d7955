#pragma once

#include <map>
#include <utility>
#include <vector>

#include "render/plan/eye_light.h"
#include "render/plan/mesh_library.h"

namespace farol::render {

/// True if a light adds nothing at all to the content of a ball (eye space), so that leaving it
/// out changes no bit: it is black, or the ball is outside its cone. Distance alone never makes a
/// light zero, attenuation only weakens it.
bool addsNothing(const EyeLight& light, const glm::dvec3& center, double radius);

/// Sets of lights without those that add nothing to a model, each kept once.
class ReachedLights {
  public:
    /// `sets`: the light sets of models; reduced sets are appended.
    explicit ReachedLights(std::vector<std::vector<EyeLight>>& sets) : sets_(sets) {}
    /// The index of the set that lights a ball as `set` does; counts those left out.
    int reduce(int set, const glm::dvec3& center, double radius, std::int64_t& skipped);

  private:
    std::vector<std::vector<EyeLight>>& sets_;
    std::map<std::pair<int, std::vector<bool>>, int> known_;
};

}  // namespace farol::render
