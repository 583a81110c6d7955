#pragma once

#include <string>

#include "scene/scene.h"

/// Small scenes for the tests of the ray caster.
namespace farol::reference::testing {

/// A camera on +Z, looking along -Z at the origin; 90 degrees, so that the half height is 1 at
/// depth 1.
inline scene::Scene emptyScene(double distance) {
    scene::Scene scene;
    scene.camera = scene::Camera{};
    scene.camera->eye = {0.0, 0.0, distance};
    scene.camera->fovDeg = 90.0;
    scene.camera->near = 1e-3;
    scene.camera->far = 1e4;
    return scene;
}

inline scene::Light directional(const glm::dvec3& towards) {
    scene::Light light;
    light.type = scene::LightType::directional;
    light.direction = towards;
    return light;
}

inline scene::Material white() {
    scene::Material material;
    material.diffuse.rgb = material.ambient.rgb = glm::vec3(0.0F);
    material.emissive.rgb = glm::vec3(1.0F);
    return material;
}

/// Adds a group with one model of the given command.
inline scene::Group& add(scene::Scene& scene, const std::string& command,
                         const scene::Material& material) {
    scene::Group& group = scene.groups.emplace_back();
    scene::Model& model = group.models.emplace_back();
    model.command = command;
    model.material = material;
    return group;
}

}  // namespace farol::reference::testing
