#include "render/plan/light_reach.h"

#include <algorithm>
#include <cmath>

namespace farol::render {
namespace {

// The shader compares cosines in single precision: 1e-4 rad is far more than that loses.
constexpr double kMargin = 1e-4;

}  // namespace

bool addsNothing(const EyeLight& light, const glm::dvec3& center, double radius) {
    const glm::vec3 all = glm::vec3(light.diffuse + light.ambient + light.specular);
    if (all == glm::vec3(0.0F)) return true;
    if (light.position.w == 0.0F || light.spot.w <= -2.0F) return false;
    const glm::dvec3 away = center - glm::dvec3(light.position);
    const double distance = glm::length(away);
    const double reach = radius * (1.0 + kMargin);
    if (distance <= reach) return false;
    const double cosine = glm::dot(away, glm::dvec3(light.spot)) / distance;
    const double nearest = std::acos(std::clamp(cosine, -1.0, 1.0)) - std::asin(reach / distance);
    return nearest > std::acos(std::clamp(double{light.spot.w}, -1.0, 1.0)) + kMargin;
}

int ReachedLights::reduce(int set, const glm::dvec3& center, double radius, std::int64_t& skipped) {
    const std::vector<EyeLight>& lights = sets_[static_cast<std::size_t>(set)];
    std::vector<bool> left(lights.size());
    std::transform(lights.begin(), lights.end(), left.begin(),
                   [&](const EyeLight& one) { return addsNothing(one, center, radius); });
    const auto count = std::count(left.begin(), left.end(), true);
    if (count == 0) return set;
    skipped += count;
    const auto [at, added] =
        known_.emplace(std::make_pair(set, left), static_cast<int>(sets_.size()));
    if (added) {
        std::vector<EyeLight> reached;
        for (std::size_t i = 0; i < lights.size(); ++i)
            if (!left[i]) reached.push_back(lights[i]);
        sets_.push_back(std::move(reached));
    }
    return at->second;
}

}  // namespace farol::render
