#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene/scene_builder.h"
#include "scene/words.h"

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
    } else if (canonical == "group") {
        state.content = true;
        Group& child = group.groups.emplace_back();
        child.where = at(element);
        const ElementSpec& spec = elementSpec("group");
        child.name = values(element, spec).text("name");
        GroupState inner;
        groupContent(element, spec, child, inner);
    }
}

void SceneBuilder::transforms(pugi::xml_node element, Group& group, GroupState& state) {
    const ElementSpec& spec = elementSpec("transform");
    if (state.transform)
        findings().warn("scene.duplicate-transform", at(element),
                        "a second <" + shown(element.name()) +
                            "> in one group; both are applied, in this order");
    state.transform = true;
    values(element, spec, isOrdered() ? Unknown::error : Unknown::warning);
    children(element, spec, [&](std::string_view canonical, pugi::xml_node child) {
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
    const std::string tag = "<" + std::string(canonical) + ">";
    if (!state.transforms.insert(canonical).second) {
        if (isOrdered() && canonical == "translate") {
            findings().error("scene.duplicate-transform", at(element),
                             "a second " + tag +
                                 " in one group; this dialect allows one: use a group inside it");
            return false;
        }
        findings().warn("scene.duplicate-transform", at(element),
                        "a second " + tag + " in one group; both are applied, in this order");
    }
    if (!state.content) return true;
    if (isOrdered()) {
        findings().error("scene.order", at(element),
                         tag +
                             " after the group's models or groups; in this dialect the "
                             "transforms come first");
        return false;
    }
    findings().warn("scene.order", at(element),
                    tag + " after the group's models or groups is applied to the whole group");
    return true;
}

std::optional<Transform> SceneBuilder::translate(pugi::xml_node element) {
    const ElementSpec& spec = elementSpec("translate");
    const Values given = values(element, spec, isOrdered() ? Unknown::error : Unknown::warning);
    const bool hasPoints = element.first_child().type() == pugi::node_element;
    if (hasPoints || given.has("time")) return curve(element, given);
    if (given.has("align"))
        findings().warn("scene.ineffective", given.where("align"),
                        "\"align\" means nothing without points");
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
    if (given.hasAny("x y z"))
        findings().warn("scene.ineffective", at(element),
                        "a <translate> along points does not use x, y and z");
    if (made.points.empty()) {
        findings().error("scene.points", at(element),
                         "<translate> with a time has no points; at least 4 are wanted");
        return std::nullopt;
    }
    if (made.points.size() < 4)
        findings().warn(
            "scene.points", at(element),
            "a curve of " + std::to_string(made.points.size()) + " points; at least 4 are wanted");
    if (!given.has("time") && !given.damaged)
        findings().warn("scene.missing-attribute", at(element),
                        "<translate> along points has no \"time\"; 1 second is taken");
    if (damaged) return std::nullopt;
    made.seconds = given.number("time", 1.0);
    made.align = given.flag("align");
    return made;
}

std::optional<Transform> SceneBuilder::rotate(pugi::xml_node element) {
    const Values given = values(element, "rotate", isOrdered() ? Unknown::error : Unknown::warning);
    if (given.damaged) return std::nullopt;
    const glm::dvec3 axis = given.vector("x", "y", "z", glm::dvec3(0.0));
    if (!given.hasAny("angle time")) {
        findings().warn("scene.missing-attribute", at(element),
                        "<rotate> has neither \"angle\" nor \"time\" and does nothing");
        return std::nullopt;
    }
    if (given.has("angle") && given.has("time"))
        findings().warn("scene.ineffective", given.where("angle"),
                        "<rotate> has a time; its angle is ignored");
    const bool still = !given.has("time") && given.number("angle") == 0.0;
    if (axis == glm::dvec3(0.0) && !still) {
        findings().error("scene.zero-direction", at(element),
                         "the axis of <rotate> is zero; give at least one of x, y and z");
        return std::nullopt;
    }
    if (const auto seconds = given.number("time")) {
        if (*seconds == 0.0) {
            findings().error("scene.range", given.where("time"),
                             "\"time\" of <rotate> is 0; it is the seconds of one turn");
            return std::nullopt;
        }
        return Spin{*seconds, axis};
    }
    if (axis == glm::dvec3(0.0)) return std::nullopt;  // no turn about no axis
    tellRadians(given, "angle", "rotate");
    return Rotate{given.number("angle", 0.0), axis};
}

std::optional<Transform> SceneBuilder::scaling(pugi::xml_node element) {
    const Values given = values(element, "scale", isOrdered() ? Unknown::error : Unknown::warning);
    if (given.damaged) return std::nullopt;
    const glm::dvec3 factors = given.vector("x", "y", "z", glm::dvec3(1.0));
    if (int{factors.x == 0.0} + int{factors.y == 0.0} + int{factors.z == 0.0} > 1)
        findings().warn("scene.invisible", at(element),
                        "<scale> by 0 leaves nothing of its group to see; 1 keeps a size");
    return Scale{factors};
}

void SceneBuilder::models(pugi::xml_node element, Group& group, GroupState& state) {
    if (state.models) {
        if (isOrdered()) {
            findings().error("scene.duplicate-models", at(element),
                             "a second <models> in one group; this dialect allows one");
            return;
        }
        findings().warn("scene.duplicate-models", at(element),
                        "a second <models> in one group is added to the first");
    }
    state.models = state.content = true;
    const ElementSpec& spec = elementSpec("models");
    values(element, spec);
    children(element, spec, [&](std::string_view, pugi::xml_node child) { model(child, group); });
}

/// 1.57 and 3.14159 are right angles of somebody who thinks in radians: what is a multiple of 15
/// degrees to a tenth of one, and no whole number of degrees, up to a full turn.
void SceneBuilder::tellRadians(const Values& given, std::string_view angle,
                               std::string_view element) {
    constexpr double kStep = 15.0, kNear = 0.1;
    const double value = given.number(angle, 0.0);
    const double steps = std::round(glm::degrees(value) / kStep);
    if (value == std::round(value) || steps == 0.0 || std::abs(steps) > 360.0 / kStep ||
        std::abs(glm::degrees(value) - steps * kStep) > kNear)
        return;
    findings().warn("scene.radians", given.where(angle),
                    quoted(angle) + " of <" + std::string(element) +
                        "> is in degrees and looks like radians; was " +
                        quoted(formatNumber(steps * kStep)) + " meant?");
}

void SceneBuilder::tellSwapped(const Values& given, std::string_view least, std::string_view most) {
    if (given.has(least) && given.has(most) && given.number(least) > given.number(most))
        findings().warn("scene.swapped", given.where(least),
                        quoted(least) + " is more than " + quoted(most) +
                            "; they are taken the other way round");
}

void SceneBuilder::scatter(pugi::xml_node element, Group& group) {
    const Values given = values(element, "scatter");
    Scatter made;
    made.count = given.integer("count").value_or(0);
    made.radiusMin = given.number("xzMin", 0.0);
    made.radiusMax = given.number("xzMax", made.radiusMin);
    made.yMin = given.number("yMin", 0.0);
    made.yMax = given.number("yMax", 0.0);
    tellSwapped(given, "xzMin", "xzMax");
    tellSwapped(given, "yMin", "yMax");
    made.seed =
        static_cast<std::uint64_t>(given.number("seed", static_cast<double>(++session_.scatters)));
    if (group.scatter)
        findings().warn("scene.duplicate-element", at(element),
                        "a second <scatter> in one group replaces the first");
    group.scatter = made;
}

}  // namespace farol::scene
