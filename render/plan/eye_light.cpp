#include "render/plan/eye_light.h"

#include <cmath>

#include "core/number.h"
#include "render/plan/instances.h"
#include "scene/animation.h"

namespace farol::render {
namespace {

glm::vec3 inReach(const glm::dvec3& place) {
    const double away = glm::length(place);
    return glm::vec3(away > kHugeNumber ? place * (kHugeNumber / away) : place);
}

}  // namespace

EyeLight eyeLight(const PlacedLight& placed, const ViewTransform& view, double timeS) {
    const scene::Light& light = *placed.light;
    const bool fixed = light.space == scene::LightSpace::camera;
    const glm::dvec3 direction = fixed ? placed.direction : view.rotation * placed.direction;
    const double size = glm::length(direction);
    const glm::vec3 unit = size > 0.0 ? glm::vec3(direction / size) : glm::vec3(0.0F);
    EyeLight eye{};
    if (light.type == scene::LightType::directional)
        eye.position = glm::vec4(unit, 0.0F);
    else
        eye.position =
            glm::vec4(inReach(fixed ? placed.position : view.eyeFromWorld(placed.position)), 1.0F);
    const bool cone = light.type == scene::LightType::spot && light.cutoffDeg < 180.0;
    eye.spot =
        glm::vec4(unit, cone ? static_cast<float>(std::cos(glm::radians(light.cutoffDeg))) : -2.0F);
    eye.attenuation = glm::vec4(light.constant, light.linear, light.quadratic, light.exponent);
    eye.diffuse = glm::vec4(scene::colorAt(light.diffuse, timeS), 0.0F);
    eye.ambient = glm::vec4(scene::colorAt(light.ambient, timeS), 0.0F);
    eye.specular = glm::vec4(scene::colorAt(light.specular, timeS), 0.0F);
    return eye;
}

}  // namespace farol::render
