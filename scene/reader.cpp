#include "scene/reader.h"

#include <algorithm>

#include "scene/scene_builder.h"

namespace farol::scene {
namespace {

/// What the dialects say of a scene as a whole.
void completeScene(Scene& scene) {
    if (scene.dialect != Dialect::engine2017 || scene.camera) return;
    Camera camera;
    camera.eye = glm::dvec3(0.0);
    camera.target = glm::dvec3(0.0, 0.0, 1.0);
    camera.fovDeg = 45.0;
    scene.camera = camera;
}

bool hasModels(const std::vector<Group>& groups) {
    return std::any_of(groups.begin(), groups.end(), [](const Group& one) {
        return !one.models.empty() || hasModels(one.groups);
    });
}

/// A picture of nothing but its background needs a word.
void tellEmpty(const Scene& scene, const std::string& name, Findings& findings) {
    const bool something = hasModels(scene.groups) || scene.entity || scene.skybox ||
                           scene.background.color || !scene.background.file.empty();
    if (!something && findings.clean())  // else what was found may be why

        findings.warn("scene.empty", {name, 1, 1},
                      "the scene has no <model>: there is nothing to draw");
}

}  // namespace

Scene readDocument(std::string_view xml, const std::string& name, ReadSession& session) {
    ReadLimits limits = session.options.limits;
    limits.elements = session.elementsLeft;
    const Document document(xml, name, limits, session.findings);
    session.elementsLeft -= document.repaired().elements;
    return SceneBuilder(document, session).build();
}

ReadResult read(std::string_view xml, const ReadOptions& options, const Assets& assets) {
    // The reader walks groups by recursion: whatever the caller allows, the stack must do.
    constexpr int kDeepest = 512;
    ReadOptions bounded = options;
    bounded.limits.depth = std::min(options.limits.depth, kDeepest);
    Findings findings(bounded.strict, bounded.limits.diagnostics);
    ReadSession session{bounded, assets, findings, {bounded.name}, bounded.limits.elements};
    ReadResult result;
    try {
        result.scene = readDocument(xml, bounded.name, session);
        completeScene(result.scene);
        tellEmpty(result.scene, bounded.name, findings);
    } catch (const Error& error) {
        findings.add(error.diagnostics());
    }
    findings.dropFollowUps();
    result.diagnostics = findings.take();
    if (!findings.failed()) return result;
    // A broken document decides over what a broken document seems to say.
    std::stable_partition(
        result.diagnostics.begin(), result.diagnostics.end(), [](const Diagnostic& one) {
            return one.severity == Severity::error && one.code.rfind("xml.", 0) == 0;
        });
    throw Error(std::move(result.diagnostics));
}

}  // namespace farol::scene
