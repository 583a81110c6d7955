#include <algorithm>

#include "scene/scene_builder.h"
#include "scene/words.h"

namespace farol::scene {

void SceneBuilder::includes(pugi::xml_node element, Group& group, bool isRoot) {
    const ElementSpec& spec = elementSpec("xmls");
    values(element, spec);
    children(element, spec, [&](std::string_view, pugi::xml_node child) {
        std::string written;
        std::optional<Scene> part = include(child, written);
        if (!part) return;
        for (auto& [file, words] : part->generatorComments)
            scene_.generatorComments.emplace(file, words);
        if (isRoot) {
            if (!scene_.camera) scene_.camera = part->camera;
            if (!scene_.window) scene_.window = part->window;
            if (!scene_.skybox) scene_.skybox = part->skybox;
            if (scene_.title.empty()) scene_.title = part->title;
            std::move(part->lights.begin(), part->lights.end(), std::back_inserter(group.lights));
            std::move(part->groups.begin(), part->groups.end(), std::back_inserter(group.groups));
            return;
        }
        Group& inner = group.groups.emplace_back();
        inner.where = at(child);
        inner.lights = std::move(part->lights);
        inner.groups = std::move(part->groups);
    });
}

std::optional<Scene> SceneBuilder::include(pugi::xml_node element, std::string& file) {
    constexpr std::size_t kDeepest = 8;
    const Values given = values(element, "xml");
    file = given.text("file");
    if (file.empty()) {
        findings().error("scene.missing-attribute", at(element),
                         "<" + shown(element.name()) + "> names no \"file\"");
        return std::nullopt;
    }
    const Location where = given.where("file");
    if (session_.files.size() > kDeepest || --session_.includesLeft < 0) {
        findings().error("limit.includes", where,
                         "too many included files: at most 64, nested 8 deep");
        return std::nullopt;
    }
    Diagnostics located;
    const std::string& current = session_.files.back();
    const std::size_t slash = current.rfind('/');
    const std::string beside =
        slash == std::string::npos ? file : current.substr(0, slash + 1) + file;
    const std::optional<std::string> path = isSafePath(beside) && session_.assets.has(beside)
                                                ? std::optional(beside)
                                                : locate(session_.assets, file, where, located);
    findings().add(std::move(located));
    if (!path) {
        findings().error("asset.missing", where,
                         "the scene " + quoted(file) + " is not in the bundle");
        return std::nullopt;
    }
    if (std::find(session_.files.begin(), session_.files.end(), *path) != session_.files.end()) {
        findings().error("scene.include-cycle", where, quoted(*path) + " includes itself");
        return std::nullopt;
    }
    session_.files.push_back(*path);
    std::optional<Scene> scene;
    try {
        const auto text = session_.assets.read(*path);
        if (text) scene = readDocument(*text, *path, session_);
    } catch (const Error& error) {
        findings().add(error.diagnostics());
    }
    session_.files.pop_back();
    return scene;
}

void SceneBuilder::entity(pugi::xml_node element) {
    if (scene_.entity) {
        findings().warn("scene.duplicate-element", at(element), "a second <entity> is ignored");
        return;
    }
    std::string file;
    if (std::optional<Scene> part = include(element, file)) {
        scene_.entity = std::make_shared<Scene>(std::move(*part));
        scene_.entityFile = file;
    }
}

}  // namespace farol::scene
