#include "grade/structure/outline.h"

#include <algorithm>

#include "scene/animation.h"

namespace farol::grade {
namespace {

class Flattener {
  public:
    Flattener(Outline& out, const render::Prepared& prepared, render::MeshLibrary& meshes)
        : out_(out), prepared_(prepared), meshes_(meshes) {}

    void visit(const scene::Group& group, int parent) {
        const int index = static_cast<int>(out_.nodes.size());
        Outline::Node node;
        node.parent = parent;
        node.scatter = group.scatter;
        node.name = group.name;
        node.where = group.where;
        node.number = index;
        for (std::size_t i = 0; i < group.transforms.size(); ++i)
            node.links.push_back(
                {group.transforms[i],
                 i < group.transformsAt.size() ? group.transformsAt[i] : group.where,
                 out_.nextLink++});
        out_.nodes.push_back(std::move(node));
        for (const scene::Light& light : group.lights) addLamp(light, index);
        for (const scene::Model& model : group.models) {
            Outline::Item item;
            item.node = index;
            item.model = model;
            item.mesh = meshes_.get(model, *prepared_.assets);
            item.material =
                model.material.value_or(scene::defaultMaterial(prepared_.scene.dialect));
            item.origin = &model;
            item.lacksMesh = isUnreadable(model.where, {"asset.", "mesh.", "shape."});
            item.lacksTexture =
                model.texture && isUnreadable(model.texture->where, {"asset.", "image."});
            item.number = static_cast<int>(out_.items.size()) + 1;
            out_.items.push_back(std::move(item));
        }
        for (const scene::Group& child : group.groups) visit(child, index);
    }

    void addLamp(const scene::Light& light, int node) {
        out_.lamps.push_back({node, light, static_cast<int>(out_.lamps.size()) + 1, false});
    }

  private:
    bool isUnreadable(const Location& where, std::initializer_list<const char*> families) const {
        return where.line > 0 &&
               std::any_of(prepared_.diagnostics.begin(), prepared_.diagnostics.end(),
                           [&](const Diagnostic& one) {
                               return one.severity == Severity::error && one.where == where &&
                                      std::any_of(families.begin(), families.end(),
                                                  [&](const char* family) {
                                                      return one.code.starts_with(family);
                                                  });
                           });
    }

    Outline& out_;
    const render::Prepared& prepared_;
    render::MeshLibrary& meshes_;
};

scene::Group groupOf(const Outline& outline, int index,
                     const std::vector<std::vector<int>>& children) {
    const Outline::Node& node = outline.nodes[static_cast<std::size_t>(index)];
    scene::Group group;
    for (const Link& link : node.links) {
        group.transforms.push_back(link.transform);
        group.transformsAt.push_back(link.where);
    }
    group.scatter = node.scatter;
    group.name = node.name;
    group.where = node.where;
    for (const Outline::Lamp& lamp : outline.lamps)
        if (lamp.node == index && !lamp.isGone) group.lights.push_back(lamp.light);
    for (const Outline::Item& item : outline.items)
        if (item.node == index && !item.isGone) {
            group.models.push_back(item.model);
            std::string& path = group.models.back().source.path;
            if (item.isReversed && !path.empty()) path = kReversedFolder + path;
            // A scene without any colour is drawn as lines.
            if (item.model.material ||
                item.material != scene::defaultMaterial(outline.rest.dialect))
                group.models.back().material = item.material;
        }
    for (const int child : children[static_cast<std::size_t>(index)])
        group.groups.push_back(groupOf(outline, child, children));
    return group;
}

}  // namespace

bool Outline::isBelow(int node, int ancestor) const {
    for (; node >= 0; node = nodes[static_cast<std::size_t>(node)].parent)
        if (node == ancestor) return true;
    return false;
}

std::vector<int> Outline::pathTo(int node) const {
    std::vector<int> path;
    for (; node >= 0; node = nodes[static_cast<std::size_t>(node)].parent) path.push_back(node);
    std::reverse(path.begin(), path.end());
    return path;
}

int Outline::placeOf(int node, int id) const {
    const std::vector<Link>& links = nodes[static_cast<std::size_t>(node)].links;
    for (std::size_t i = 0; i < links.size(); ++i)
        if (links[i].id == id) return static_cast<int>(i);
    return -1;
}

Outline outlineOf(const render::Prepared& prepared, render::MeshLibrary& meshes) {
    Outline out;
    out.nodes.emplace_back();
    const scene::Scene& scene = prepared.scene;
    out.rest = scene;
    out.rest.groups.clear();
    out.rest.lights.clear();
    Flattener flattener(out, prepared, meshes);
    for (const scene::Light& light : scene.lights) flattener.addLamp(light, 0);
    for (const scene::Group& group : scene.groups) flattener.visit(group, 0);
    return out;
}

scene::Scene sceneOf(const Outline& outline) {
    scene::Scene scene = outline.rest;
    std::vector<std::vector<int>> children(outline.nodes.size());
    for (std::size_t i = 1; i < outline.nodes.size(); ++i)
        if (!outline.nodes[i].isGone)
            children[static_cast<std::size_t>(outline.nodes[i].parent)].push_back(
                static_cast<int>(i));
    for (const Outline::Lamp& lamp : outline.lamps)
        if (lamp.node == 0 && !lamp.isGone) scene.lights.push_back(lamp.light);
    // Transforms of the world, and models in it, are a repair's.
    scene::Group world = groupOf(outline, 0, children);
    if (world.transforms.empty() && world.models.empty()) {
        scene.groups = std::move(world.groups);
    } else {
        world.lights.clear();
        scene.groups.push_back(std::move(world));
    }
    return scene;
}

glm::dmat4 matrixOf(const std::vector<Link>& links, double timeS) {
    glm::dmat4 matrix(1.0);
    for (const Link& link : links) matrix = matrix * scene::matrixAt(link.transform, timeS);
    return matrix;
}

Poses posesOf(const Outline& outline, double timeS) {
    Poses poses(outline.nodes.size(), glm::dmat4(1.0));
    std::vector<bool> isKnown(outline.nodes.size(), false);
    // Repairs may hang a node below one of a higher index.
    for (std::size_t i = 0; i < outline.nodes.size(); ++i) {
        std::vector<std::size_t> open;
        for (int at = static_cast<int>(i); at >= 0 && !isKnown[static_cast<std::size_t>(at)];
             at = outline.nodes[static_cast<std::size_t>(at)].parent)
            open.push_back(static_cast<std::size_t>(at));
        for (; !open.empty(); open.pop_back()) {
            const std::size_t at = open.back();
            const Outline::Node& node = outline.nodes[at];
            const glm::dmat4 above =
                node.parent < 0 ? glm::dmat4(1.0) : poses[static_cast<std::size_t>(node.parent)];
            poses[at] = above * matrixOf(node.links, timeS);
            isKnown[at] = true;
        }
    }
    return poses;
}

int depthOf(const Outline& outline, int node) {
    return static_cast<int>(outline.pathTo(node).size());
}

}  // namespace farol::grade
