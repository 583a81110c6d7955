#include "tests/support/ray_caster/shading.h"

#include <cmath>

namespace farol::reference {
namespace {

glm::dvec3 unitOrZero(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

double power(double base, double exponent) {
    return exponent == 0.0 ? 1.0 : std::pow(base, exponent);
}

glm::dvec3 clamp01(const glm::dvec3& c) { return glm::clamp(c, 0.0, 1.0); }

}  // namespace

bool inCone(const EyeLight& light, const glm::dvec3& point) {
    if (!light.positional || light.cutoffDeg >= 180.0) return true;
    const glm::dvec3 away = unitOrZero(point - light.position);
    return glm::dot(away, light.shining) >= std::cos(glm::radians(light.cutoffDeg));
}

glm::dvec3 shade(const Rules& rules, const Dress& dress, const std::vector<EyeLight>& lights,
                 const glm::dvec3& point, const glm::dvec3& normal, const glm::dvec3& texture,
                 std::uint64_t shadowed) {
    glm::dvec3 primary = dress.emissive + dress.ambient * rules.globalAmbient;
    glm::dvec3 secondary(0.0);
    const glm::dvec3 viewer =
        rules.viewer == scene::Viewer::local ? unitOrZero(-point) : glm::dvec3(0.0, 0.0, 1.0);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const EyeLight& light = lights[i];
        if (!inCone(light, point)) continue;
        glm::dvec3 towards = light.towards;
        double strength = 1.0;
        if (light.positional) {
            const double d = glm::distance(light.position, point);
            towards = unitOrZero(light.position - point);
            strength /= light.attenuation.x + light.attenuation.y * d + light.attenuation.z * d * d;
            if (light.cutoffDeg < 180.0)
                strength *= power(std::max(0.0, -glm::dot(towards, light.shining)), light.exponent);
        }
        const double facing = glm::dot(normal, towards);
        primary += strength * dress.ambient * light.ambient;
        if (!(facing > 0.0) || (shadowed >> (i % 64) & 1U)) continue;
        primary += strength * facing * dress.diffuse * light.diffuse;
        const double glint = std::max(0.0, glm::dot(normal, unitOrZero(towards + viewer)));
        secondary += strength * power(glint, dress.shininess) * dress.specular * light.specular;
    }
    if (rules.specular == scene::Specular::single) return clamp01(primary + secondary) * texture;
    return clamp01(clamp01(primary) * texture + clamp01(secondary));
}

}  // namespace farol::reference
