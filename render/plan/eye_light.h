#pragma once

#include <glm/glm.hpp>

#include "render/plan/camera.h"

namespace farol::render {

struct PlacedLight;

/// EyeLight::diffuse.w of lights that cast shadows. Shaders count them in this order, greatest
/// first.
inline constexpr float kMapShadow = 1.0F, kCubeShadow = 2.0F, kCascadeShadow = 3.0F;

/// A light as shaders read it, in eye space.
struct EyeLight {
    glm::vec4 position;     ///< w = 1: place; w = 0: unit vector towards the light
    glm::vec4 spot;         ///< unit direction of shining; w: cosine of the cutoff, -2: no cone
    glm::vec4 attenuation;  ///< constant, linear, quadratic; w: spot exponent
    glm::vec4 diffuse;      ///< w: 0 where it casts no shadows, else as above
    glm::vec4 ambient;      ///< w: the index of its FramePlan::shadowLights
    glm::vec4 specular;
    bool operator==(const EyeLight&) const = default;
};

/// Returns a placed light for the shaders, with its colours at a time. Moves places beyond 1e18 to
/// that distance, along their direction: squares of larger distances overflow float.
EyeLight eyeLight(const PlacedLight& placed, const ViewTransform& view, double timeS);

}  // namespace farol::render
