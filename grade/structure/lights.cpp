#include "grade/structure/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/text.h"
#include "grade/structure/messages.h"
#include "grade/structure/slips.h"

namespace farol::grade {
namespace {

using scene::kLightTypeWords;
using scene::Light;
using scene::LightType;

constexpr double kSameCos = 0.99999;  // a quarter of a degree
constexpr double kSameLength = 1e-3;  // of the scene's extent

double cosine(const glm::dvec3& a, const glm::dvec3& b) {
    const double lengths = glm::length(a) * glm::length(b);
    return lengths > 0.0 ? glm::dot(a, b) / lengths : 1.0;
}

/// A light in world space.
struct Placed {
    int lamp = 0;
    glm::dvec3 position{0.0}, direction{0.0};
};

class LightSearch {
  public:
    LightSearch(const SearchContext& context, const Outline& mine)
        : context_(context),
          mine_(mine),
          poses_(posesOf(mine, context.timesS.front())),
          theirs_(place(context.theirs, context.theirSide.poses.front())),
          ours_(place(mine, poses_)) {}

    std::vector<Fix> run() {
        std::vector<std::vector<double>> costs(theirs_.size());
        for (std::size_t i = 0; i < theirs_.size(); ++i)
            for (std::size_t j = 0; j < ours_.size(); ++j)
                costs[i].push_back(cost(theirs_[i], ours_[j]) +
                                   0.02 *
                                       std::abs(static_cast<double>(i) - static_cast<double>(j)));
        constexpr double kStrangers = 3.0;
        const std::vector<int> partner =
            ours_.empty() ? std::vector<int>(theirs_.size(), -1) : assign(costs, kStrangers);
        std::vector<bool> isTaken(ours_.size(), false);
        for (std::size_t i = 0; i < theirs_.size(); ++i) {
            if (partner[i] < 0) {
                tellMissing(theirs_[i]);
                continue;
            }
            isTaken[static_cast<std::size_t>(partner[i])] = true;
            compare(theirs_[i], ours_[static_cast<std::size_t>(partner[i])]);
        }
        for (std::size_t j = 0; j < ours_.size(); ++j)
            if (!isTaken[j]) {
                const int lamp = ours_[j].lamp;
                say("light.extra", lamp, {causeMessage<"part.predicate/extra">(), {}}, "",
                    [lamp](Outline& o) { o.lamps[static_cast<std::size_t>(lamp)].isGone = true; });
            }
        return std::move(out_);
    }

  private:
    static std::vector<Placed> place(const Outline& outline, const Poses& poses) {
        std::vector<Placed> out;
        for (std::size_t l = 0; l < outline.lamps.size(); ++l) {
            const Outline::Lamp& lamp = outline.lamps[l];
            if (lamp.isGone) continue;
            Placed placed{static_cast<int>(l), lamp.light.position, lamp.light.direction};
            if (lamp.light.space == scene::LightSpace::world && lamp.node > 0) {
                const glm::dmat4& world = poses[static_cast<std::size_t>(lamp.node)];
                placed.position = glm::dvec3(world * glm::dvec4(lamp.light.position, 1.0));
                placed.direction = glm::dmat3(world) * lamp.light.direction;
            }
            out.push_back(placed);
        }
        return out;
    }

    const Light& theirLight(const Placed& one) const {
        return context_.theirs.lamps[static_cast<std::size_t>(one.lamp)].light;
    }
    const Outline::Lamp& lampOf(const Placed& one) const {
        return mine_.lamps[static_cast<std::size_t>(one.lamp)];
    }

    double cost(const Placed& a, const Placed& b) const {
        const Light &wanted = theirLight(a), &given = lampOf(b).light;
        double sum = wanted.type == given.type ? 0.0 : 0.8;
        if (wanted.type != LightType::directional && given.type != LightType::directional) {
            // Also as its own numbers are: it may stand in another group.
            const double away = std::min(glm::length(a.position - b.position),
                                         glm::length(wanted.position - given.position));
            sum += std::min(1.0, 2.0 * away / context_.sceneSize);
        }
        if (wanted.type != LightType::point && given.type != LightType::point)
            sum += 0.4 * (1.0 - std::abs(cosine(a.direction, b.direction)));
        if (!(wanted.diffuse == given.diffuse)) sum += 0.2;
        return sum;
    }

    void say(const char* code, int lamp, CauseWords words, const std::string& kind,
             std::function<void(Outline&)> apply) {
        Fix fix;
        fix.code = code;
        fix.who = causeMessage<"part.who/light">(
            "number"_arg = mine_.lamps[static_cast<std::size_t>(lamp)].number);
        fix.words = std::move(words);
        fix.kind = std::string(code) + " " + kind;
        fix.where = mine_.lamps[static_cast<std::size_t>(lamp)].light.where;
        fix.apply = std::move(apply);
        out_.push_back(std::move(fix));
    }

    void tellMissing(const Placed& theirs) {
        const Outline::Lamp& wanted = context_.theirs.lamps[static_cast<std::size_t>(theirs.lamp)];
        Fix fix;
        fix.code = "light.missing";
        fix.who =
            causeMessage<"part.who/light-kind">("type"_arg = kLightTypeWords[wanted.light.type]);
        fix.words = {
            causeMessage<"part.predicate/missing">(),
            wanted.light.type != LightType::directional
                ? causeMessage<"part.values/place">("expected"_arg = shortNumbers(theirs.position))
                : causeMessage<"part.values/direction">("expected"_arg =
                                                            shortNumbers(theirs.direction))};
        fix.kind = "light.missing";
        Light light = wanted.light;
        light.where = {};
        if (light.space == scene::LightSpace::world) {
            light.position = theirs.position;
            light.direction = theirs.direction;
        }
        fix.apply = [light](Outline& o) { o.lamps.push_back({0, light, 0, false}); };
        out_.push_back(std::move(fix));
    }

    /// A change of one field.
    template <typename Field, typename Value>
    static std::function<void(Outline&)> setting(int lamp, Field field, Value value) {
        return [lamp, field, value](Outline& o) {
            o.lamps[static_cast<std::size_t>(lamp)].light.*field = value;
        };
    }

    void compare(const Placed& theirs, const Placed& ours) {
        const Light &wanted = theirLight(theirs), &given = lampOf(ours).light;
        const int lamp = ours.lamp;
        if (wanted.type != given.type) {
            Light right = wanted;
            right.where = given.where;
            right.position = localPoint(lampOf(ours).node, theirs.position);
            right.direction = localDirection(lampOf(ours).node, theirs.direction);
            return say("light.type", lamp,
                       {causeMessage<"part.predicate/light-type">(
                            "value"_arg = kLightTypeWords[given.type],
                            "expected"_arg = kLightTypeWords[wanted.type]),
                        {}},
                       "", [lamp, right](Outline& o) {
                           o.lamps[static_cast<std::size_t>(lamp)].light = right;
                       });
        }
        if (wanted.space != given.space)
            say("light.space", lamp, {causeMessage<"part.predicate/light-space">(), {}}, "",
                setting(lamp, &Light::space, wanted.space));
        const bool isElsewhere = comparePlace(theirs, ours);
        if (!isElsewhere && wanted.type != LightType::point) compareDirection(theirs, ours);
        if (wanted.type == LightType::spot) compareSpot(wanted, ours);
        compareStrength(wanted, ours);
    }

    glm::dvec3 localPoint(int node, const glm::dvec3& world) const {
        return glm::dvec3(glm::inverse(poses_[static_cast<std::size_t>(node)]) *
                          glm::dvec4(world, 1.0));
    }
    glm::dvec3 localDirection(int node, const glm::dvec3& world) const {
        return glm::dvec3(glm::inverse(glm::dmat3(poses_[static_cast<std::size_t>(node)])) * world);
    }

    /// Returns true where the light belongs to another group: no more is reported then.
    bool comparePlace(const Placed& theirs, const Placed& ours) {
        const Light &wanted = theirLight(theirs), &given = lampOf(ours).light;
        const int lamp = ours.lamp, own = lampOf(ours).node;
        const bool isPlaced =
            wanted.type == LightType::directional ||
            glm::length(theirs.position - ours.position) <= kSameLength * context_.sceneSize;
        const bool isTurned =
            wanted.type == LightType::point || cosine(theirs.direction, ours.direction) > kSameCos;
        if (isPlaced && isTurned) return false;
        if (wanted.space == scene::LightSpace::world) {
            // Its numbers may be right in another group.
            for (std::size_t h = 0; h < mine_.nodes.size(); ++h) {
                if (mine_.nodes[h].isGone || static_cast<int>(h) == own) continue;
                const glm::dmat4& world = poses_[h];
                const glm::dvec3 there(world * glm::dvec4(given.position, 1.0)),
                    towards = glm::dmat3(world) * given.direction;
                if ((wanted.type != LightType::directional &&
                     glm::length(there - theirs.position) > kSameLength * context_.sceneSize) ||
                    (wanted.type != LightType::point &&
                     cosine(towards, theirs.direction) < kSameCos))
                    continue;
                const auto node = static_cast<int>(h);
                say("light.group", lamp, {wordsOfGroup(own, node), {}}, "",
                    [lamp, node](Outline& o) {
                        o.lamps[static_cast<std::size_t>(lamp)].node = node;
                    });
                return true;
            }
        }
        if (isPlaced) return false;
        const glm::dvec3 right = wanted.space == scene::LightSpace::world
                                     ? localPoint(own, theirs.position)
                                     : theirs.position;
        const Slip slip = slipOfVector(given.position, right, "position");
        CauseWords words = slip.words();
        if (slip.code != "transform.sign" && slip.code != "transform.coordinates")
            words.finding = causeMessage<"part.predicate/place">();
        say("light.position", lamp, std::move(words), slip.kind,
            setting(lamp, &Light::position, right));
        return false;
    }

    Message wordsOfGroup(int own, int right) const {
        if (own == 0)
            return causeMessage<"part.predicate/light-from-world">("group"_arg =
                                                                       nameOfNode(mine_, right));
        if (right == 0)
            return causeMessage<"part.predicate/light-to-world">("value"_arg =
                                                                     nameOfNode(mine_, own));
        return causeMessage<"part.predicate/light-group">(
            "value"_arg = nameOfNode(mine_, own), "expected"_arg = nameOfNode(mine_, right));
    }

    void compareDirection(const Placed& theirs, const Placed& ours) {
        const Light& given = lampOf(ours).light;
        const double along = cosine(theirs.direction, ours.direction);
        if (along >= kSameCos) return;
        const glm::dvec3 right = theirLight(theirs).space == scene::LightSpace::world
                                     ? localDirection(lampOf(ours).node, theirs.direction)
                                     : theirs.direction;
        const Message values = twoValues(given.direction, right);
        const auto apply = setting(ours.lamp, &Light::direction, right);
        if (along < -kSameCos)
            return say("light.direction-negated", ours.lamp,
                       {causeMessage<"part.predicate/direction-negated">(), values}, "", apply);
        say("light.direction", ours.lamp, {causeMessage<"part.predicate/direction">(), values}, "",
            apply);
    }

    void compareSpot(const Light& wanted, const Placed& ours) {
        const Light& given = lampOf(ours).light;
        if (std::abs(wanted.cutoffDeg - given.cutoffDeg) > 1e-3) {
            const double degrees = given.cutoffDeg * 180.0 / std::numbers::pi;
            const bool isRadians = std::abs(degrees - wanted.cutoffDeg) < 0.02 * wanted.cutoffDeg;
            say(isRadians ? "light.cutoff-radians" : "light.cutoff", ours.lamp,
                {isRadians ? causeMessage<"part.predicate/cutoff-radians">()
                 : given.cutoffDeg > wanted.cutoffDeg
                     ? causeMessage<"part.predicate/cutoff-large">()
                     : causeMessage<"part.predicate/cutoff-small">(),
                 twoValues(given.cutoffDeg, wanted.cutoffDeg)},
                "", setting(ours.lamp, &Light::cutoffDeg, wanted.cutoffDeg));
        }
        if (std::abs(wanted.exponent - given.exponent) > 1e-3)
            say("light.exponent", ours.lamp,
                {given.exponent > wanted.exponent ? causeMessage<"part.predicate/exponent-large">()
                                                  : causeMessage<"part.predicate/exponent-small">(),
                 twoValues(given.exponent, wanted.exponent)},
                "", setting(ours.lamp, &Light::exponent, wanted.exponent));
    }

    void compareStrength(const Light& wanted, const Placed& ours) {
        const Light& given = lampOf(ours).light;
        const int lamp = ours.lamp;
        const glm::dvec3 a(wanted.constant, wanted.linear, wanted.quadratic),
            b(given.constant, given.linear, given.quadratic);
        if (wanted.type != LightType::directional && glm::length(a - b) > 1e-6)
            say("light.attenuation", lamp,
                {causeMessage<"part.predicate/attenuation">(), twoValues(b, a)}, "",
                [lamp, a](Outline& o) {
                    Light& light = o.lamps[static_cast<std::size_t>(lamp)].light;
                    light.constant = a.x;
                    light.linear = a.y;
                    light.quadratic = a.z;
                });
        struct Channel {
            const char* name;
            scene::Color Light::*at;
        };
        std::vector<std::string> names, values, expected;
        std::vector<scene::Color Light::*> wrong;
        for (const Channel& one :
             {Channel{"diffuse", &Light::diffuse}, Channel{"ambient", &Light::ambient},
              Channel{"specular", &Light::specular}}) {
            const scene::Color &theirs = wanted.*one.at, &mine = given.*one.at;
            const glm::vec3 apart = glm::abs(theirs.rgb - mine.rgb);
            if (theirs.cycles == mine.cycles &&
                std::max({apart.x, apart.y, apart.z}) <= 1.0F / 255.0F)
                continue;
            names.emplace_back(one.name);
            values.push_back(names.back() + " " + levels(mine));
            expected.push_back(names.back() + " " + levels(theirs));
            wrong.push_back(one.at);
        }
        if (wrong.empty()) return;
        say("light.color", lamp,
            {wrong.size() > 1
                 ? causeMessage<"part.predicate/light-colors">("channels"_arg = listOf(names))
                 : causeMessage<"part.predicate/light-color">("channel"_arg = names.front()),
             twoValues(joined(values, ", "), joined(expected, ", "))},
            joined(names, " "), [lamp, wrong, wanted](Outline& o) {
                for (const auto& at : wrong)
                    o.lamps[static_cast<std::size_t>(lamp)].light.*at = wanted.*at;
            });
    }

    const SearchContext& context_;
    const Outline& mine_;
    Poses poses_;
    std::vector<Placed> theirs_, ours_;
    std::vector<Fix> out_;
};

}  // namespace

std::vector<Fix> explainLights(const SearchContext& context, const Outline& mine) {
    return LightSearch(context, mine).run();
}

std::vector<Fix> explainCamera(const SearchContext& context, const Outline& mine) {
    std::vector<Fix> out;
    if (!context.theirs.rest.camera) return out;
    const scene::Camera& wanted = *context.theirs.rest.camera;
    const auto say = [&](const char* code, CauseWords words,
                         std::function<void(scene::Camera&)> change) {
        Fix fix;
        fix.code = code;
        fix.who = causeMessage<"part.who/camera">();
        fix.words = std::move(words);
        fix.kind = code;
        fix.where = mine.rest.camera ? mine.rest.camera->where : Location{};
        fix.apply = [change = std::move(change)](Outline& o) {
            if (!o.rest.camera) o.rest.camera.emplace();
            change(*o.rest.camera);
        };
        out.push_back(std::move(fix));
    };
    if (!mine.rest.camera) {
        say("camera.missing", {causeMessage<"part.predicate/missing">(), {}},
            [wanted](scene::Camera& c) { c = wanted; });
        return out;
    }
    const scene::Camera& given = *mine.rest.camera;
    const auto vector = [&](const char* code, const std::string& name, const glm::dvec3& from,
                            const glm::dvec3& to, glm::dvec3 scene::Camera::*at) {
        say(code, {slipOfVector(from, to, name).words().finding, twoValues(from, to)},
            [at, to](scene::Camera& c) { c.*at = to; });
    };
    const double reach = kSameLength * context.sceneSize;
    const glm::dvec3 theirs = wanted.target - wanted.eye, ours = given.target - given.eye;
    if (glm::length(wanted.eye - given.eye) > reach)
        vector("camera.position", "position", given.eye, wanted.eye, &scene::Camera::eye);
    // A camera that moved may still look at the same point: that is one fault, not two.
    if (cosine(theirs, ours) < kSameCos && glm::length(wanted.target - given.target) > reach)
        vector("camera.target", "lookAt", given.target, wanted.target, &scene::Camera::target);
    // Only the part of `up` across the view turns the image.
    if (cosine(glm::cross(theirs, wanted.up), glm::cross(theirs, given.up)) < kSameCos)
        vector("camera.up", "up", given.up, wanted.up, &scene::Camera::up);
    if (std::abs(wanted.fovDeg - given.fovDeg) > 1e-3) {
        const double degrees = given.fovDeg * 180.0 / std::numbers::pi;
        const bool isRadians = std::abs(degrees - wanted.fovDeg) < 0.02 * wanted.fovDeg;
        say(isRadians ? "camera.fov-radians" : "camera.fov",
            {isRadians                      ? causeMessage<"part.predicate/fov-radians">()
             : given.fovDeg > wanted.fovDeg ? causeMessage<"part.predicate/fov-large">()
                                            : causeMessage<"part.predicate/fov-small">(),
             twoValues(given.fovDeg, wanted.fovDeg)},
            [fov = wanted.fovDeg](scene::Camera& c) { c.fovDeg = fov; });
    }
    if (std::abs(wanted.near - given.near) > 1e-6 * wanted.near ||
        std::abs(wanted.far - given.far) > 1e-6 * wanted.far)
        say("camera.range",
            {causeMessage<"part.predicate/range">(),
             causeMessage<"part.values/range">(
                 "near"_arg = shortNumber(given.near), "far"_arg = shortNumber(given.far),
                 "first"_arg = shortNumber(wanted.near), "last"_arg = shortNumber(wanted.far))},
            [wanted](scene::Camera& c) {
                c.near = wanted.near;
                c.far = wanted.far;
            });
    return out;
}

}  // namespace farol::grade
