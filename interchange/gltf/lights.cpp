#include <algorithm>
#include <cmath>
#include <numbers>

#include "interchange/gltf/writer.h"
#include "interchange/messages.h"
#include "scene/animation.h"

namespace farol::interchange {

using nlohmann::json;

namespace {

/// Distance, world units, at which a light whose attenuation is not quadratic is as strong as in
/// the scene.
double referenceDistance(const scene::Light& light, const render::Box& bounds) {
    if (bounds.empty()) return 1.0;
    const double distance = glm::distance(light.position, (bounds.min + bounds.max) * 0.5);
    const double radius = glm::length(bounds.max - bounds.min) * 0.5;
    return std::max({distance, radius * 0.1, 1e-3});
}

}  // namespace

std::optional<int> GltfWriter::addLight(const scene::Light& light) {
    const glm::vec3 color = linearOf(scene::colorAt(light.diffuse, subject_.timeS()));
    const float largest = std::max({color.r, color.g, color.b});
    if (largest <= 0.0F) return std::nullopt;
    json value{{"color", toJson(color / largest)}};
    double intensity = kUnitLight * double{largest};
    scene::LightType type = light.type;
    if (type == scene::LightType::spot && light.cutoffDeg > 90.0) {
        if (light.cutoffDeg < 180.0)
            approximate(message<"part.feature-wide-spot">(), message<"part.instead-point">(),
                        light.where);
        type = scene::LightType::point;
    }
    if (type != scene::LightType::directional) {
        const double d = light.constant == 0.0 && light.linear == 0.0
                             ? 1.0
                             : referenceDistance(light, subject_.placed().bounds);
        intensity *= d * d / (light.constant + light.linear * d + light.quadratic * d * d);
        if (light.constant != 0.0 || light.linear != 0.0)
            approximate(message<"part.feature-attenuation">(), message<"part.instead-square">(),
                        light.where);
    }
    value["intensity"] = intensity;
    value["type"] = scene::kLightTypeWords[type];
    if (type == scene::LightType::spot) {
        const double outer = std::min(std::max(light.cutoffDeg, 0.01) * std::numbers::pi / 180.0,
                                      std::numbers::pi / 2.0);
        // At its edge the scene's cone ends with this share of its middle's strength.
        const bool fades = std::pow(std::cos(outer), light.exponent) < 0.5;
        if (light.exponent > 0.0)
            approximate(
                message<"part.feature-exponent">(),
                fades ? message<"part.instead-inner-cone">() : message<"part.instead-even-cone">(),
                light.where);
        value["spot"] = {{"outerConeAngle", outer},
                         {"innerConeAngle", fades ? 0.0 : outer * 0.999}};
    }
    document_.use("KHR_lights_punctual");
    json& lights = document_.root()["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back(std::move(value));
    json node{{"name", scene::kLightTypeWords[light.type]}};
    node["extensions"]["KHR_lights_punctual"]["light"] = lights.size() - 1;
    if (type != scene::LightType::directional) node["translation"] = toJson(light.position);
    if (type != scene::LightType::point) {
        const double sign = type == scene::LightType::directional ? -1.0 : 1.0;
        node["rotation"] = toJson(facing(sign * light.direction));
    }
    ++written_.lights;
    return document_.add("nodes", std::move(node));
}

void GltfWriter::addLights(const std::vector<scene::Light>& lights, json& children) {
    if (!subject_.isLit()) return;
    for (const scene::Light& light : lights)
        if (const std::optional<int> node = addLight(light))
            (light.space == scene::LightSpace::camera ? viewerNodes_ : children).push_back(*node);
}

}  // namespace farol::interchange
