#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scene/scene_builder.h"

namespace farol::scene {
namespace {

/// Towards the light: `alpha` about Y, `beta` about X, degrees; both 0 is +Z.
glm::dvec3 sphericalDirection(double alphaDeg, double betaDeg) {
    const double a = glm::radians(std::fmod(alphaDeg, 360.0));
    const double b = glm::radians(std::fmod(betaDeg, 360.0));
    return {std::sin(a) * std::cos(b), std::sin(b), std::cos(a) * std::cos(b)};
}

const char* typeName(LightType type) {
    if (type == LightType::directional) return "directional";
    return type == LightType::spot ? "spot" : "point";
}

/// What the light says it is, else what its attributes say.
LightType lightType(const Values& given) {
    const std::string& type = given.text("type");
    if (!type.empty())
        return type == "directional" ? LightType::directional
               : type == "spot"      ? LightType::spot
                                     : LightType::point;
    if (given.has("cutoff")) return LightType::spot;
    const bool place = given.hasAny("posX posY posZ");
    if (!place && given.hasAny("alpha beta dirX dirY dirZ")) return LightType::directional;
    return LightType::point;
}

}  // namespace

void SceneBuilder::lights(pugi::xml_node element, Group& group, GroupState& state) {
    if (state.lights)
        findings().warn("scene.duplicate-element", at(element),
                        "a second <lights> in one group is added to the first");
    state.lights = true;
    const ElementSpec& spec = elementSpec("lights");
    values(element, spec);
    children(element, spec, [&](std::string_view, pugi::xml_node child) { light(child, group); });
}

void SceneBuilder::light(pugi::xml_node element, Group& group) {
    constexpr int kMaxOf2020 = 8;
    if (++lightCount_ > kMaxOf2020 && scene_.dialect == Dialect::engine2020) {
        if (lightCount_ == kMaxOf2020 + 1)
            findings().error("limit.lights", at(element),
                             "this is the ninth light; the 2020 dialect allows 8");
        return;
    }
    const Values given = values(element, "light");
    Light made;
    made.where = at(element);
    const std::string& type = given.text("type");
    made.type = lightType(given);
    if (given.text("space") == "camera") made.space = LightSpace::camera;
    if (type.empty() && !given.hasAny("alpha beta") && !given.damaged)
        findings().warn("scene.missing-attribute", at(element),
                        std::string("<light> has no \"type\"; it is taken as a ") +
                            typeName(made.type) + " light");
    tellRadians(given, "cutoff", "light");
    made.cutoffDeg = given.number("cutoff", 180.0);
    made.exponent = given.number("exponent", 0.0);
    colorAttributes(given, "diff", made.diffuse);
    colorAttributes(given, "ambt", made.ambient);
    colorAttributes(given, "spec", made.specular);
    namedColor(given, "diffuse", made.diffuse);
    namedColor(given, "ambient", made.ambient);
    namedColor(given, "specular", made.specular);
    lightAttenuation(element, given, made);
    lightDirection(element, given, made, !type.empty());
    if (!given.damaged) group.lights.push_back(made);
}

void SceneBuilder::lightDirection(pugi::xml_node element, const Values& given, Light& made,
                                  bool typed) {
    const glm::dvec3 position = given.vector("posX", "posY", "posZ", glm::dvec3(0.0));
    const glm::dvec3 direction = given.vector("dirX", "dirY", "dirZ", glm::dvec3(0.0));
    if (made.type != LightType::directional) made.position = position;
    if (made.type == LightType::point || given.damaged) return;
    const bool hasDirection = given.hasAny("dirX dirY dirZ");
    if (given.hasAny("alpha beta") && made.type == LightType::directional) {
        made.direction = sphericalDirection(given.number("alpha", 0.0), given.number("beta", 0.0));
        return;
    }
    made.direction = direction;
    if (made.type == LightType::directional && !hasDirection && given.hasAny("posX posY posZ")) {
        made.direction = position;
        if (typed && scene_.dialect == Dialect::course)
            findings().warn("scene.missing-attribute", at(element),
                            "the directional <light> has a position but no direction; its "
                            "position is taken as the vector towards it");
    } else if (made.type == LightType::spot && !hasDirection && isOrdered()) {
        made.direction = glm::dvec3(0.0, 0.0, -1.0);  // OpenGL's default
    }
    if (made.direction == glm::dvec3(0.0))
        findings().error("scene.zero-direction", at(element),
                         std::string("the direction of the ") +
                             (made.type == LightType::spot ? "spot" : "directional") +
                             " <light> is zero; give at least one of dirX, dirY and dirZ");
}

void SceneBuilder::lightAttenuation(pugi::xml_node element, const Values& given, Light& made) {
    made.constant = given.number("constant", 1.0);
    made.linear = given.number("linear", 0.0);
    made.quadratic = given.number("quadratic", 0.0);
    if (made.constant != 0.0 || made.linear != 0.0 || made.quadratic != 0.0) return;
    if (scene_.dialect == Dialect::engine2020) {
        made.constant = 1.0;  // this dialect's 0 says: no attenuation
    } else if (!given.damaged) {
        findings().error("scene.attenuation", at(element),
                         "constant, linear and quadratic of <light> are all 0, which divides by "
                         "zero; write constant=\"1\" for no attenuation");
    }
}

}  // namespace farol::scene
