#include "grade/requirements/motion.h"

#include <algorithm>
#include <cmath>

namespace farol::grade {
namespace {

constexpr double kStill = 0.05;    // of the distance to what turns about it
constexpr double kNothing = 1e-4;  // of a size: rounding

/// Moments of a period that no simple part of another one falls on.
constexpr double kMoments[] = {0.0, 0.191, 0.382, 0.613, 0.809};

/// The angle, radians, by which the direction turns in a period, in the plane that it turns in
/// most; nothing where it passes through the middle.
std::optional<double> turnOf(const std::vector<glm::dvec3>& ways) {
    double most = 0.0, least = 1e300;
    for (const glm::dvec3& way : ways) {
        most = std::max(most, glm::length(way));
        least = std::min(least, glm::length(way));
    }
    if (!(least > kNothing * most)) return std::nullopt;
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i + 1 < ways.size(); ++i) sum += glm::cross(ways[i], ways[i + 1]);
    if (!(glm::length(sum) > kNothing * most * most)) return std::nullopt;
    const glm::dvec3 normal = glm::normalize(sum);
    double angle = 0.0;
    for (std::size_t i = 0; i + 1 < ways.size(); ++i) {
        const glm::dvec3 a = ways[i] - normal * glm::dot(normal, ways[i]);
        const glm::dvec3 b = ways[i + 1] - normal * glm::dot(normal, ways[i + 1]);
        angle += std::atan2(glm::dot(normal, glm::cross(a, b)), glm::dot(a, b));
    }
    return std::abs(angle);
}

}  // namespace

bool Motion::moves(std::size_t object) const {
    const double size = std::max(inventory_.radius(object, 0.0), 1e-9);
    const glm::dvec3 start = inventory_.middle(object, -1, 0.0);
    for (const double period : inventory_.periodsAbove(inventory_.objects()[object].node))
        for (const double moment : kMoments)
            if (glm::length(inventory_.middle(object, -1, moment * period) - start) >
                kNothing * std::max(size, glm::length(start)))
                return true;
    return false;
}

bool Motion::turns(std::size_t object) const {
    for (int at = inventory_.objects()[object].node; at >= 0;
         at = inventory_.nodes()[static_cast<std::size_t>(at)].parent)
        for (const scene::Transform& transform :
             inventory_.nodes()[static_cast<std::size_t>(at)].group->transforms)
            if (std::holds_alternative<scene::Spin>(transform)) return true;
    return false;
}

std::vector<std::pair<const scene::FollowCurve*, Location>> Motion::curvesOf(
    std::size_t object) const {
    std::vector<std::pair<const scene::FollowCurve*, Location>> curves;
    for (int at = inventory_.objects()[object].node; at >= 0;
         at = inventory_.nodes()[static_cast<std::size_t>(at)].parent) {
        const scene::Group& group = *inventory_.nodes()[static_cast<std::size_t>(at)].group;
        for (std::size_t i = 0; i < group.transforms.size(); ++i)
            if (const auto* curve = std::get_if<scene::FollowCurve>(&group.transforms[i]))
                curves.emplace_back(
                    curve, i < group.transformsAt.size() ? group.transformsAt[i] : group.where);
    }
    return curves;
}

bool Motion::standsStill(std::size_t object, int node, const std::vector<double>& timesS,
                         double reach) const {
    const glm::dvec3 start = inventory_.middle(object, node, timesS.front());
    return std::all_of(timesS.begin(), timesS.end(), [&](double timeS) {
        return glm::length(inventory_.middle(object, node, timeS) - start) <= reach;
    });
}

std::optional<Orbit> Motion::findOrbit(int node, std::size_t object, std::size_t other) const {
    constexpr int kSamples = 48;
    constexpr double kTurn = 2.0 * 3.14159265358979323846, kEnough = 5.0 / 6.0 * kTurn;
    for (const double period : inventory_.periodsAbove(inventory_.objects()[object].node)) {
        std::vector<double> timesS;
        std::vector<glm::dvec3> ways;
        double distance = 0.0;
        for (int i = 0; i <= kSamples; ++i) {
            timesS.push_back(period * i / kSamples);
            ways.push_back(inventory_.middle(object, node, timesS.back()) -
                           inventory_.middle(other, node, timesS.back()));
            distance += glm::length(ways.back()) / (kSamples + 1);
        }
        const std::optional<double> angle = turnOf(ways);
        if (angle && *angle >= kEnough && standsStill(other, node, timesS, kStill * distance))
            return Orbit{period * kTurn / *angle, distance};
    }
    return std::nullopt;
}

std::optional<Orbit> Motion::orbit(std::size_t object, std::size_t other) {
    if (object == other) return std::nullopt;
    const auto known = orbits_.find({object, other});
    if (known != orbits_.end()) return known->second;
    std::optional<Orbit> found;
    int node =
        inventory_.commonOf(inventory_.objects()[object].node, inventory_.objects()[other].node);
    while (true) {
        found = findOrbit(node, object, other);
        if (found || node < 0) break;
        node = inventory_.nodes()[static_cast<std::size_t>(node)].parent;
    }
    orbits_.emplace(Pair{object, other}, found);
    return found;
}

std::vector<double> Motion::sampledTimes(std::size_t object, std::size_t other) const {
    std::vector<double> timesS{0.0};
    for (const std::size_t one : {object, other})
        for (const double period : inventory_.periodsAbove(inventory_.objects()[one].node))
            for (const double moment : kMoments) timesS.push_back(moment * period);
    return timesS;
}

double Motion::radiusIn(std::size_t object, int node) const {
    double scale = 1.0;
    if (node >= 0) {
        const glm::dmat3 world(inventory_.matrix(node, -1, 0.0));
        scale = std::cbrt(std::abs(glm::determinant(world)));
    }
    return scale > 0.0 ? inventory_.radius(object, 0.0) / scale : 0.0;
}

bool Motion::findHanging(std::size_t object, std::size_t other) const {
    const int mine = inventory_.objects()[object].node, theirs = inventory_.objects()[other].node;
    if (mine == theirs) return false;
    if (inventory_.isBelow(mine, theirs)) return true;
    const int node = inventory_.commonOf(mine, theirs);
    if (node < 0) return false;
    const std::vector<double> timesS = sampledTimes(object, other);
    const double radius = radiusIn(other, node);
    const glm::dvec3 place = inventory_.middle(other, node, 0.0);
    const double away = glm::length(place);
    if (!standsStill(other, node, timesS, kStill * std::max(away, radius))) return false;
    if (away <= radius)
        return std::all_of(timesS.begin(), timesS.end(), [&](double timeS) {
            return glm::length(inventory_.middle(object, node, timeS)) > radius;
        });
    return radiusIn(object, node) < radius &&
           std::all_of(timesS.begin(), timesS.end(), [&](double timeS) {
               return glm::length(inventory_.middle(object, node, timeS) -
                                  inventory_.middle(other, node, timeS)) < 0.5 * away;
           });
}

bool Motion::hangsFrom(std::size_t object, std::size_t other) {
    if (object == other) return false;
    const auto known = hanging_.find({object, other});
    if (known != hanging_.end()) return known->second;
    return hanging_.emplace(Pair{object, other}, findHanging(object, other)).first->second;
}

}  // namespace farol::grade
