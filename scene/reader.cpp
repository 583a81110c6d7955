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
    } catch (const Error& error) {
        findings.add(error.diagnostics());
    }
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
