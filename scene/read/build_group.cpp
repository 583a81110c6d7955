#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "core/text.h"
#include "scene/messages.h"
#include "scene/read/scene_builder.h"

namespace farol::scene {

void SceneBuilder::groupContent(pugi::xml_node element, const ElementSpec& spec, Group& group,
                                GroupState& state) {
    children(element, spec, [&](std::string_view canonical, pugi::xml_node child) {
        if (state.isRoot && rootElement(canonical, child)) return;
        groupElement(canonical, child, group, state);
    });
}

void SceneBuilder::groupElement(std::string_view canonical, pugi::xml_node element, Group& group,
                                GroupState& state) {
    if (canonical == "transform") {
        transforms(element, group, state);
    } else if (canonical == "translate" || canonical == "rotate" || canonical == "scale") {
        transform(canonical, element, group, state);
    } else if (canonical == "lights") {
        lights(element, group, state);
    } else if (canonical == "light") {
        light(element, group);
    } else if (canonical == "models") {
        models(element, group, state);
    } else if (canonical == "model") {
        state.content = true;
        model(element, group);
    } else if (canonical == "scatter") {
        scatter(element, group);
    } else if (canonical == "xmls") {
        state.content = true;
        includes(element, group, state.isRoot);
    } else if (canonical == "xml") {
        state.content = true;
        includeInto(element, group, state.isRoot);
    } else if (canonical == "color") {
        groupColor(element);
    } else if (canonical == "group") {
        state.content = true;
        Group& child = group.groups.emplace_back();
        child.where = at(element);
        const ElementSpec& spec = elementSpec("group");
        child.name = values(element, spec).text("name");
        GroupState inner;
        const std::optional<GroupColor> outer = session_.groupColor;
        groupContent(element, spec, child, inner);
        session_.groupColor = outer;
    }
}

void SceneBuilder::transforms(pugi::xml_node element, Group& group, GroupState& state) {
    const ElementSpec& spec = elementSpec("transform");
    if (state.transform)
        findings().warn(message<"scene.duplicate-transform">("element"_arg = element.name()),
                        at(element));
    state.transform = true;
    values(element, spec);
    children(element, spec, [&](std::string_view canonical, pugi::xml_node child) {
        if (canonical == "color")
            groupColor(child);
        else
            transform(canonical, child, group, state);
    });
}

void SceneBuilder::transform(std::string_view canonical, pugi::xml_node element, Group& group,
                             GroupState& state) {
    if (!transformAllowed(canonical, element, state)) return;
    const std::optional<Transform> made = canonical == "translate" ? translate(element)
                                          : canonical == "rotate"  ? rotate(element)
                                                                   : scaling(element);
    if (!made) return;
    group.transforms.push_back(*made);
    group.transformsAt.push_back(at(element));
}

bool SceneBuilder::transformAllowed(std::string_view canonical, pugi::xml_node element,
                                    GroupState& state) {
    if (!state.transforms.insert(canonical).second) {
        if (isOrdered() && canonical == "translate") {
            findings().error(message<"scene.duplicate-transform/one">("element"_arg = canonical),
                             at(element));
            return false;
        }
        findings().warn(message<"scene.duplicate-transform">("element"_arg = canonical),
                        at(element));
    }
    if (!state.content) return true;
    if (isOrdered()) {
        findings().error(message<"scene.order">("element"_arg = canonical), at(element));
        return false;
    }
    findings().warn(message<"scene.order/whole">("element"_arg = canonical), at(element));
    return true;
}

std::optional<Transform> SceneBuilder::translate(pugi::xml_node element) {
    const ElementSpec& spec = elementSpec("translate");
    bool hasPoints = false;
    for (const pugi::xml_node child : element.children())
        hasPoints = hasPoints || findChild(spec, child.name()) != nullptr;
    const Values given = values(element, spec, hasPoints ? Unknown::warning : Unknown::error);
    if (given.has("tracking") && !trackingNoted_) {
        trackingNoted_ = true;
        findings().info(message<"scene.ineffective/tracking">(), given.where("tracking"));
    }
    if (hasPoints || given.has("time")) return curve(element, given);
    if (given.has("align"))
        findings().warn(message<"scene.ineffective/align">(), given.where("align"));
    if (given.damaged) return std::nullopt;
    return Translate{given.vector("x", "y", "z", glm::dvec3(0.0))};
}

std::optional<Transform> SceneBuilder::curve(pugi::xml_node element, const Values& given) {
    FollowCurve made;
    bool damaged = given.damaged;
    children(element, elementSpec("translate"), [&](std::string_view, pugi::xml_node child) {
        const Values point = values(child, "point");
        damaged = damaged || point.damaged;
        made.points.push_back(point.vector("x", "y", "z", glm::dvec3(0.0)));
    });
    if (given.hasAny("x y z")) findings().warn(message<"scene.ineffective/offset">(), at(element));
    if (made.points.empty()) {
        findings().error(message<"scene.points/none">(), at(element));
        return std::nullopt;
    }
    if (made.points.size() < 4)
        findings().warn(message<"scene.points">("count"_arg = made.points.size()), at(element));
    if (!given.has("time") && !given.damaged)
        findings().warn(message<"scene.missing-attribute/lap">(), at(element));
    if (damaged) return std::nullopt;
    made.seconds = given.number("time", 1.0);
    if (made.seconds == 0.0) {
        findings().warn(message<"scene.range/lap">(), given.where("time"));
        return Translate{made.points.front()};
    }
    made.align = given.flag("align");
    return made;
}

std::optional<Transform> SceneBuilder::rotate(pugi::xml_node element) {
    const Values given = values(element, "rotate", Unknown::error);
    if (given.damaged) return std::nullopt;
    const glm::dvec3 axis = given.vector("x", "y", "z", glm::dvec3(0.0));
    if (!given.hasAny("angle time")) {
        findings().warn(message<"scene.missing-attribute/rotate">(), at(element));
        return std::nullopt;
    }
    if (given.has("angle") && given.has("time"))
        findings().warn(message<"scene.ineffective/angle">(), given.where("angle"));
    const bool isStill = !given.has("time") && given.number("angle") == 0.0;
    if (axis == glm::dvec3(0.0)) {
        if (!isStill) findings().warn(message<"scene.zero-direction/rotate">(), at(element));
        return std::nullopt;
    }
    if (const auto seconds = given.number("time")) {
        if (*seconds != 0.0) return Spin{*seconds, axis};
        findings().warn(message<"scene.range/turn">(), given.where("time"));
        return std::nullopt;
    }
    warnIfRadians(given, "angle", "rotate");
    return Rotate{given.number("angle", 0.0), axis};
}

std::optional<Transform> SceneBuilder::scaling(pugi::xml_node element) {
    const Values given = values(element, "scale", Unknown::error);
    if (given.damaged) return std::nullopt;
    const glm::dvec3 factors = given.vector("x", "y", "z", glm::dvec3(1.0));
    if (int{factors.x == 0.0} + int{factors.y == 0.0} + int{factors.z == 0.0} > 1)
        findings().warn(message<"scene.invisible">(), at(element));
    return Scale{factors};
}

void SceneBuilder::models(pugi::xml_node element, Group& group, GroupState& state) {
    if (state.models) {
        if (isOrdered()) {
            findings().error(message<"scene.duplicate-models/one">(), at(element));
            return;
        }
        findings().warn(message<"scene.duplicate-models">(), at(element));
    }
    state.models = state.content = true;
    const ElementSpec& spec = elementSpec("models");
    values(element, spec);
    children(element, spec, [&](std::string_view canonical, pugi::xml_node child) {
        if (canonical == "xml")
            includeInto(child, group, state.isRoot);
        else
            model(child, group);
    });
}

/// Warns where an angle looks like radians (1.57, 3.14159): a fraction that, converted from
/// radians, is within 0.1 degrees of a multiple of 15 degrees, up to a full turn.
void SceneBuilder::warnIfRadians(const Values& given, std::string_view angle,
                                 std::string_view element) {
    constexpr double kStep = 15.0, kNear = 0.1;
    const double value = given.number(angle, 0.0);
    const double steps = std::round(glm::degrees(value) / kStep);
    if (value == std::round(value) || steps == 0.0 || std::abs(steps) > 360.0 / kStep ||
        std::abs(glm::degrees(value) - steps * kStep) > kNear)
        return;
    findings().warn(message<"scene.radians">("name"_arg = angle, "element"_arg = element,
                                             "value"_arg = value, "suggestion"_arg = steps * kStep),
                    given.where(angle));
}

void SceneBuilder::warnIfSwapped(const Values& given, std::string_view least,
                                 std::string_view most) {
    if (given.has(least) && given.has(most) && given.number(least) > given.number(most))
        findings().warn(message<"scene.swapped">("min"_arg = least, "max"_arg = most),
                        given.where(least));
}

void SceneBuilder::scatter(pugi::xml_node element, Group& group) {
    const Values given = values(element, "scatter");
    Scatter made;
    made.count = given.integer("count").value_or(0);
    made.radiusMin = given.number("xzMin", 0.0);
    made.radiusMax = given.number("xzMax", made.radiusMin);
    made.yMin = given.number("yMin", 0.0);
    made.yMax = given.number("yMax", 0.0);
    warnIfSwapped(given, "xzMin", "xzMax");
    warnIfSwapped(given, "yMin", "yMax");
    made.seed =
        static_cast<std::uint64_t>(given.number("seed", static_cast<double>(++session_.scatters)));
    if (group.scatter) findings().warn(message<"scene.duplicate-element/scatter">(), at(element));
    group.scatter = made;
}

}  // namespace farol::scene
