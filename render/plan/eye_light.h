#pragma once

#include <glm/glm.hpp>

namespace farol::render {

/// A light as shaders read it, in eye space.
struct EyeLight {
    glm::vec4 position;     ///< w = 1: place; w = 0: unit vector towards the light
    glm::vec4 spot;         ///< unit direction of shining; w: cosine of the cutoff, -2: no cone
    glm::vec4 attenuation;  ///< constant, linear, quadratic; w: spot exponent
    glm::vec4 diffuse, ambient, specular;
    bool operator==(const EyeLight&) const = default;
};

}  // namespace farol::render
