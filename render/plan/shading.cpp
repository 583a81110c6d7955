#include "render/plan/shading.h"

#include <algorithm>

#include "render/plan/messages.h"

namespace farol::render {
namespace {

bool anyModel(const std::vector<scene::Group>& groups, bool (*test)(const scene::Model&)) {
    return std::any_of(groups.begin(), groups.end(), [&](const scene::Group& group) {
        return std::any_of(group.models.begin(), group.models.end(), test) ||
               anyModel(group.groups, test);
    });
}

/// The automatic choice: without lights, colours and textures the wireframe of the first phases;
/// without lights unlit; else lit per pixel.
scene::Shading automaticShading(const scene::Scene& scene, const InstanceList& list) {
    if (!list.lights.empty()) return scene::Shading::phong;
    const bool dressed = list.dressed || anyModel(scene.groups, [](const scene::Model& model) {
                             return model.material.has_value() || model.texture.has_value();
                         });
    return dressed ? scene::Shading::solid : scene::Shading::wireframe;
}

}  // namespace

scene::Shading chooseShading(const scene::Scene& scene, const PictureOptions& options,
                             const InstanceList& list) {
    if (options.shading) return *options.shading;
    return scene.settings.shading ? *scene.settings.shading : automaticShading(scene, list);
}

bool isLit(scene::Shading shading, const InstanceList& list) {
    const bool isSurface = shading == scene::Shading::flat || shading == scene::Shading::gouraud ||
                           shading == scene::Shading::phong;
    return isSurface && !list.lights.empty();
}

bool hasShadows(const scene::Scene& scene, const PictureOptions& options, const FrameStyle& style,
                const InstanceList& list, Diagnostics& findings) {
    const scene::Shadows asked =
        options.shadows.value_or(scene.settings.shadows.value_or(scene::Shadows::off));
    if (asked == scene::Shadows::off || style.layer != Layer::color) return false;
    if (style.lit && style.shading == scene::Shading::phong) return true;
    const std::string shading(scene::kShadingWords[style.shading]);
    findings.push_back(diagnosticOf(Severity::warning,
                                    list.lights.empty()
                                        ? message<"scene.shadows/unlit">()
                                        : message<"scene.shadows">("shading"_arg = shading),
                                    scene.where));
    return false;
}

}  // namespace farol::render
