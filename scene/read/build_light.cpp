#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene/messages.h"
#include "scene/read/scene_builder.h"

namespace farol::scene {
namespace {

/// Towards the light: `alpha` about Y, `beta` about X, degrees; both 0 is +Z.
glm::dvec3 sphericalDirection(double alphaDeg, double betaDeg) {
    const double a = glm::radians(std::fmod(alphaDeg, 360.0));
    const double b = glm::radians(std::fmod(betaDeg, 360.0));
    return {std::sin(a) * std::cos(b), std::sin(b), std::cos(a) * std::cos(b)};
}

/// Returns the type that the attribute names, else the one that fits the other attributes.
LightType lightType(const Values& attributes) {
    if (const auto type = kLightTypeWords.find(attributes.text("type"))) return *type;
    if (attributes.has("cutoff")) return LightType::spot;
    const bool place = attributes.hasAny("posX posY posZ");
    if (!place && attributes.hasAny("alpha beta dirX dirY dirZ")) return LightType::directional;
    return LightType::point;
}

}  // namespace

void SceneBuilder::lights(pugi::xml_node element, Group& group, GroupState& state) {
    if (state.lights) findings().warn(message<"scene.duplicate-element/lights">(), at(element));
    state.lights = true;
    const ElementSpec& spec = elementSpec("lights");
    values(element, spec);
    children(element, spec, [&](std::string_view, pugi::xml_node child) { light(child, group); });
}

void SceneBuilder::light(pugi::xml_node element, Group& group) {
    constexpr int kMaxOf2020 = 8;
    if (++lightCount_ > kMaxOf2020 && scene_.dialect == Dialect::engine2020) {
        if (lightCount_ == kMaxOf2020 + 1)
            findings().error(
                message<"limit.lights">("count"_arg = lightCount_, "max"_arg = kMaxOf2020),
                at(element));
        return;
    }
    const Values attributes = values(element, "light");
    Light light;
    light.where = at(element);
    const std::string& type = attributes.text("type");
    light.type = lightType(attributes);
    if (attributes.text("space") == "camera") light.space = LightSpace::camera;
    if (type.empty() && !attributes.hasAny("alpha beta") && !attributes.damaged)
        findings().warn(
            message<"scene.missing-attribute/light-type">("type"_arg = kLightTypeWords[light.type]),
            at(element));
    warnIfRadians(attributes, "cutoff", "light");
    if (light.type == LightType::spot && !attributes.has("cutoff") && !attributes.damaged)
        findings().warn(message<"scene.missing-attribute/light-cutoff">(), at(element));
    light.cutoffDeg = attributes.number("cutoff", 180.0);
    light.exponent = attributes.number("exponent", 0.0);
    colorAttributes(attributes, "diff", light.diffuse);
    colorAttributes(attributes, "ambt", light.ambient);
    colorAttributes(attributes, "spec", light.specular);
    namedColor(attributes, "diffuse", light.diffuse);
    namedColor(attributes, "ambient", light.ambient);
    namedColor(attributes, "specular", light.specular);
    lightAttenuation(element, attributes, light);
    lightDirection(element, attributes, light, !type.empty());
    if (!attributes.damaged) group.lights.push_back(light);
}

void SceneBuilder::lightDirection(pugi::xml_node element, const Values& attributes, Light& light,
                                  bool typed) {
    const glm::dvec3 position = attributes.vector("posX", "posY", "posZ", glm::dvec3(0.0));
    const glm::dvec3 direction = attributes.vector("dirX", "dirY", "dirZ", glm::dvec3(0.0));
    if (light.type != LightType::directional) light.position = position;
    if (light.type == LightType::point || attributes.damaged) return;
    const bool hasDirection = attributes.hasAny("dirX dirY dirZ");
    if (attributes.hasAny("alpha beta") && light.type == LightType::directional) {
        light.direction =
            sphericalDirection(attributes.number("alpha", 0.0), attributes.number("beta", 0.0));
        return;
    }
    light.direction = direction;
    if (light.type == LightType::directional && !hasDirection &&
        attributes.hasAny("posX posY posZ")) {
        light.direction = position;
        if (typed && scene_.dialect == Dialect::course)
            findings().warn(message<"scene.missing-attribute/light-direction">(), at(element));
    } else if (light.type == LightType::spot && !hasDirection && isOrdered()) {
        light.direction = glm::dvec3(0.0, 0.0, -1.0);  // OpenGL's default
    }
    if (light.direction == glm::dvec3(0.0))
        findings().error(message<"scene.zero-direction">("type"_arg = kLightTypeWords[light.type]),
                         at(element));
}

void SceneBuilder::lightAttenuation(pugi::xml_node element, const Values& attributes,
                                    Light& light) {
    light.constant = attributes.number("constant", 1.0);
    light.linear = attributes.number("linear", 0.0);
    light.quadratic = attributes.number("quadratic", 0.0);
    if (light.constant != 0.0 || light.linear != 0.0 || light.quadratic != 0.0) return;
    if (scene_.dialect == Dialect::engine2020) {
        light.constant = 1.0;  // 0 0 0 means no attenuation in this dialect
    } else if (!attributes.damaged) {
        findings().error(message<"scene.attenuation">(), at(element));
    }
}

}  // namespace farol::scene
