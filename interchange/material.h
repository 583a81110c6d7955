#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace farol::interchange {

/// A material in the metallic-roughness model of glTF 2.0 (appendix B) with KHR_materials_specular.
/// Colours are linear (Rec. 709 primaries), 0..1.
struct PbrMaterial {
    glm::vec3 baseColor{1.0F};
    float roughness = 1.0F;  ///< perceptual; alpha = roughness^2
    glm::vec3 emissive{0.0F};
    glm::vec3 reflectance{0.0F};  ///< F0, 0..kMaxReflectance; F90 is 1. Black: no highlight
};

/// F0 of specularColorFactor 1, an index of refraction of 1.5.
inline constexpr float kUnitReflectance = 0.04F;
/// Below 1: Blender 3 derives an index of refraction from F0, which F0 = 1 has none for.
inline constexpr float kMaxReflectance = 0.95F;

/// Illuminance, lux, and luminous intensity at distance 1, cd, of a light of strength 1: the
/// diffuse part of glTF is baseColor / pi.
inline constexpr double kUnitLight = 3.14159265358979323846;

/// Returns the linear value of a display value by the transfer function of sRGB (IEC 61966-2-1),
/// clamped to 0..1.
float linearOf(float display);
glm::vec3 linearOf(const glm::vec3& display);

/// A scene's material with its colours at one time, display values.
struct PhongColors {
    glm::vec3 diffuse{0.0F};
    glm::vec3 base{0.0F};  ///< where no light reaches: emissive + ambient * ambient light
    glm::vec3 specular{0.0F};
    float shininess = 0.0F;
};

/// Returns the nearest PBR material. A face without light, and one that a white light of strength 1
/// meets at right angles, have the same colours as in the scene:
///   emissive = linear(base), baseColor = linear(base + diffuse) - emissive.
/// The highlight has the width and the height of Blinn-Phong's, by the distribution of Blinn with
/// exponent n = 2 / alpha^2 - 2 (Walter et al. 2007, "Microfacet Models for Refraction", section
/// 5.2): roughness = (2 / (n + 2))^(1/4). Its peak by a light of strength 1 is F0 / (4 alpha^2) in
/// GGX's form, so F0 = 8 specular / (n + 2).
PbrMaterial pbrOf(const PhongColors& colors);

}  // namespace farol::interchange
