#include "interchange/material.h"

#include <algorithm>
#include <cmath>

namespace farol::interchange {

float linearOf(float display) {
    const double value = std::clamp(double{display}, 0.0, 1.0);
    return static_cast<float>(value <= 0.04045 ? value / 12.92
                                               : std::pow((value + 0.055) / 1.055, 2.4));
}

glm::vec3 linearOf(const glm::vec3& display) {
    return {linearOf(display.r), linearOf(display.g), linearOf(display.b)};
}

PbrMaterial pbrOf(const PhongColors& colors) {
    PbrMaterial pbr;
    pbr.emissive = linearOf(colors.base);
    pbr.baseColor = glm::clamp(linearOf(colors.base + colors.diffuse) - pbr.emissive, 0.0F, 1.0F);
    const float largest = std::max({colors.specular.r, colors.specular.g, colors.specular.b});
    if (largest <= 0.0F) return pbr;
    const float alphaSquared = 2.0F / (colors.shininess + 2.0F);
    pbr.roughness = std::sqrt(std::sqrt(alphaSquared));
    pbr.reflectance =
        glm::min(4.0F * alphaSquared * linearOf(colors.specular), glm::vec3(kMaxReflectance));
    return pbr;
}

}  // namespace farol::interchange
