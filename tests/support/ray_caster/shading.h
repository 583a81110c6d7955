#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace farol::reference {

/// A light in eye space.
struct EyeLight {
    bool positional = false;
    glm::dvec3 position{0.0};  ///< positional
    glm::dvec3 towards{0.0};   ///< directional: unit, towards the light
    glm::dvec3 shining{0.0};   ///< spot: unit
    double cutoffDeg = 180.0;  ///< 180: no cone
    double exponent = 0.0;
    glm::dvec3 attenuation{1.0, 0.0, 0.0};  ///< constant, linear, quadratic
    glm::dvec3 diffuse{1.0}, ambient{0.0}, specular{1.0};
};

struct Dress {
    glm::dvec3 diffuse, ambient, specular, emissive;
    double shininess = 0.0;
};

struct Rules {
    glm::dvec3 globalAmbient{1.0};
    scene::Viewer viewer = scene::Viewer::infinite;
    scene::Specular specular = scene::Specular::single;
};

/// Is the point in the light's cone? Without a cone, yes.
bool inCone(const EyeLight& light, const glm::dvec3& point);

/// OpenGL 2.1, section 2.14.1 and 3.9: the colour 0..1 of a point in eye space with a unit normal
/// and the texture's colour there (1 where there is none). `shadowed`: a bit for each light that
/// does not reach the point; its ambient part does.
glm::dvec3 shade(const Rules& rules, const Dress& dress, const std::vector<EyeLight>& lights,
                 const glm::dvec3& point, const glm::dvec3& normal, const glm::dvec3& texture,
                 std::uint64_t shadowed = 0);

}  // namespace farol::reference
