#include <algorithm>

#include "core/text.h"
#include "scene/messages.h"
#include "scene/read/scene_builder.h"

namespace farol::scene {

void SceneBuilder::includes(pugi::xml_node element, Group& group, bool isRoot) {
    const ElementSpec& spec = elementSpec("xmls");
    values(element, spec);
    children(element, spec,
             [&](std::string_view, pugi::xml_node child) { includeInto(child, group, isRoot); });
}

/// Puts the scene that an <xml file> names into the group.
void SceneBuilder::includeInto(pugi::xml_node element, Group& group, bool isRoot) {
    std::string written;
    std::optional<Scene> part = include(element, written);
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
    inner.where = at(element);
    inner.lights = std::move(part->lights);
    inner.groups = std::move(part->groups);
}

std::optional<Scene> SceneBuilder::include(pugi::xml_node element, std::string& file) {
    constexpr std::size_t kMaxDepth = 8;
    constexpr int kMaxIncludes = 64;  // ReadSession::includesLeft
    const Values given = values(element, "xml");
    file = given.text("file");
    if (file.empty()) {
        findings().error(
            message<"scene.missing-attribute">("element"_arg = element.name(), "name"_arg = "file"),
            at(element));
        return std::nullopt;
    }
    const Location where = given.where("file");
    if (session_.files.size() > kMaxDepth || --session_.includesLeft < 0) {
        findings().error(
            message<"limit.includes">("max"_arg = kMaxIncludes, "depth"_arg = kMaxDepth), where);
        return std::nullopt;
    }
    Diagnostics located;
    const std::optional<std::string> path = session_.locator.locate(file, where, located);
    findings().add(std::move(located));
    if (!path) {
        findings().error(message<"asset.missing/scene">("file"_arg = uncut(file)), where);
        return std::nullopt;
    }
    if (std::find(session_.files.begin(), session_.files.end(), *path) != session_.files.end()) {
        findings().error(message<"scene.include-cycle">("file"_arg = uncut(*path)), where);
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
        findings().warn(message<"scene.duplicate-element/entity">(), at(element));
        return;
    }
    std::string file;
    if (std::optional<Scene> part = include(element, file)) {
        scene_.entity = std::make_shared<Scene>(std::move(*part));
        scene_.entityFile = file;
    }
}

}  // namespace farol::scene
