#include "render/plan/shadow_maps.h"

// What the GL is given of planned maps.
namespace farol::render {

glm::dmat4 LightView::clip() const {
    const glm::dvec2 middle = 0.5 * (min + max), half = 0.5 * (max - min);
    glm::dmat4 clip(0.0);
    clip[0][0] = 1.0 / half.x;
    clip[1][1] = 1.0 / half.y;
    if (isPerspective) {
        clip[2][0] = middle.x / half.x;
        clip[2][1] = middle.y / half.y;
        clip[2][3] = -1.0;
        clip[3][2] = nearest;
        return clip;
    }
    clip[3][0] = -middle.x / half.x;
    clip[3][1] = -middle.y / half.y;
    clip[2][2] = 1.0 / (farthest - nearest);
    clip[3][2] = farthest / (farthest - nearest);
    clip[3][3] = 1.0;
    return clip;
}

EyeShadowLight eyeShadowLight(const PlannedShadows& shadows, const PlannedShadowLight& light,
                              const ViewTransform& view) {
    EyeShadowLight out{};
    std::array<float, 8> layers{};
    const bool isCascade = light.isCascade();
    const LightView* first = nullptr;
    for (std::size_t face = 0; face < 6; ++face) {
        out.faces[face] = glm::vec4(0.0F, 0.0F, 2.0F, 2.0F);
        if (light.maps[face] < 0) continue;
        const LightView& map = shadows.maps[static_cast<std::size_t>(light.maps[face])].light;
        if (first == nullptr) first = &map;
        const glm::dvec2 middle = 0.5 * (map.min + map.max), half = 0.5 * (map.max - map.min);
        out.faces[face] = glm::vec4(glm::dvec4(1.0 / half, -middle / half));
        layers[face] = static_cast<float>(light.maps[face]);
        if (!isCascade) continue;
        const double range = map.farthest - map.nearest;
        for (int i = 0; i < 2; ++i)
            out.depths[face / 2][static_cast<int>(face % 2) * 2 + i] =
                static_cast<float>((i == 0 ? -1.0 : map.farthest) / range);
    }
    out.layers = {glm::vec4(layers[0], layers[1], layers[2], layers[3]),
                  glm::vec4(layers[4], layers[5], 0.0F, 0.0F)};
    if (first == nullptr) return out;
    const glm::dmat3 turn = light.rotation * glm::transpose(view.rotation);
    const glm::dvec3 offset = light.rotation * (view.eye - first->origin);
    const auto row = [&](int i) {
        return glm::vec4(glm::dvec4(turn[0][i], turn[1][i], turn[2][i], offset[i]));
    };
    out.right = row(0);
    out.up = row(1);
    out.back = row(2);
    const double range = first->farthest - first->nearest;
    out.facts = first->isPerspective ? glm::vec4(first->nearest, 0.0, 0.0, 0.0)
                                     : glm::vec4(0.0, -1.0 / range, first->farthest / range, 0.0);
    return out;
}

void PlannedShadows::mark(std::vector<EyeLight>& list) const {
    for (std::size_t i = 0; i < ofLights.size(); ++i) {
        if (ofLights[i] < 0) continue;
        const PlannedShadowLight& light = lights[static_cast<std::size_t>(ofLights[i])];
        list[i].diffuse.w = light.isCube        ? kCubeShadow
                            : light.isCascade() ? kCascadeShadow
                                                : kMapShadow;
        list[i].ambient.w = static_cast<float>(ofLights[i]);
    }
}

}  // namespace farol::render
