#include "scene/read/reader.h"

#include <algorithm>

#include "core/utf16.h"
#include "scene/expansion.h"
#include "scene/messages.h"
#include "scene/read/scene_builder.h"

namespace farol::scene {
namespace {

bool hasModels(const std::vector<Group>& groups) {
    return std::any_of(groups.begin(), groups.end(), [](const Group& one) {
        return !one.models.empty() || hasModels(one.groups);
    });
}

bool hasLights(const std::vector<Group>& groups) {
    return std::any_of(groups.begin(), groups.end(), [](const Group& group) {
        return !group.lights.empty() || hasLights(group.groups);
    });
}

bool hasLights(const Scene& scene) { return !scene.lights.empty() || hasLights(scene.groups); }

/// Warns where the image would show nothing but its background.
void warnIfEmpty(const Scene& scene, Findings& findings) {
    if (findings.failed()) return;  // nothing is drawn anyway
    const bool isVisible = hasModels(scene.groups) || scene.skybox || scene.background.color ||
                           !scene.background.file.empty() ||
                           (scene.entity && hasModels(scene.entity->groups));
    if (!isVisible) findings.warn(message<"scene.empty">(), scene.where);
}

}  // namespace

Scene readDocument(std::string_view xml, const std::string& name, ReadSession& session) {
    ReadLimits limits = session.options.limits;
    limits.elements = session.elementsLeft;
    // Too large a document is refused by its own size, before it is copied.
    const std::optional<std::string> wide =
        xml.size() <= limits.bytes ? utf16ToUtf8(xml) : std::nullopt;
    if (wide) {
        xml = *wide;
        limits.bytes += limits.bytes / 2;
    }
    const Document document(xml, name, limits, session.findings);
    session.elementsLeft -= document.repaired().elements;
    return SceneBuilder(document, session).build();
}

ReadResult read(std::string_view xml, const ReadOptions& options, const Assets& assets) {
    // The reader recurses into groups: cap the caller's limit to protect the stack.
    constexpr int kMaxDepth = 512;
    ReadOptions bounded = options;
    bounded.limits.depth = std::min(options.limits.depth, kMaxDepth);
    Findings findings(bounded.strict, bounded.limits.diagnostics);
    Locator locator(assets, {bounded.name, bounded.path});
    ReadSession session{bounded,  assets,         locator,
                        findings, {bounded.name}, bounded.limits.elements};
    ReadResult result;
    try {
        result.scene = readDocument(xml, bounded.name, session);
        // Without light, a group's colour is that of its lines.
        if (session.usesGroupColor && !session.hasOwnColors && !hasLights(result.scene) &&
            !result.scene.settings.shading)
            result.scene.settings.shading = Shading::wireframe;
        result.scene.document = {bounded.name, bounded.path};
        checkExpansion(result.scene, findings);
        warnIfEmpty(result.scene, findings);
    } catch (const Error& error) {
        findings.add(error.diagnostics());
        result.scene.where = {};
    }
    findings.dropFollowUps();
    result.diagnostics = findings.take();
    const bool isScene = result.scene.where.line > 0;
    if (!findings.failed() || (bounded.leaveOut && isScene)) return result;
    // Faults of the XML come before faults of the scene, which they may cause.
    std::stable_partition(
        result.diagnostics.begin(), result.diagnostics.end(), [](const Diagnostic& one) {
            return one.severity == Severity::error && one.code.rfind("xml.", 0) == 0;
        });
    throw Error(std::move(result.diagnostics));
}

}  // namespace farol::scene
