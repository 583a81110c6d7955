#include "grade/requirements/inventory.h"

#include <algorithm>
#include <set>

#include "core/digest.h"
#include "core/text.h"
#include "generator/entry.h"
#include "grade/requirements/form_of.h"
#include "grade/requirements/messages.h"
#include "image/image_file.h"
#include "render/plan/messages.h"
#include "scene/animation.h"
#include "scene/expansion.h"

namespace farol::grade {

Inventory::Inventory(const render::Prepared& prepared, render::MeshLibrary& meshes)
    : prepared_(prepared) {
    for (const scene::Light& light : prepared.scene.lights) {
        const int ordinal = static_cast<int>(ordinals_.size());
        lights_.push_back({&light, -1, ordinals_.emplace(&light, ordinal).first->second});
    }
    for (const scene::Group& group : prepared.scene.groups) visit(group, -1, meshes);
}

/// In the order of render::collect, whose numbers the id layer shows.
void Inventory::visit(const scene::Group& group, int parent, render::MeshLibrary& meshes) {
    const int depth = parent < 0 ? 1 : nodes_[static_cast<std::size_t>(parent)].depth + 1;
    const auto add = [&](const glm::dmat4& copy) {
        nodes_.push_back({parent, depth, &group, copy});
        fill(static_cast<int>(nodes_.size()) - 1, meshes);
    };
    if (!group.scatter) return add(glm::dmat4(1.0));
    for (const glm::dmat4& copy : scene::scatterMatrices(*group.scatter, group.scatter->seed))
        add(copy);
}

void Inventory::fill(int node, render::MeshLibrary& meshes) {
    const scene::Group& group = *nodes_[static_cast<std::size_t>(node)].group;
    for (const scene::Light& light : group.lights) {
        const int ordinal = static_cast<int>(ordinals_.size());
        lights_.push_back({&light, node, ordinals_.emplace(&light, ordinal).first->second});
    }
    for (const scene::Model& model : group.models) {
        if (objects_.size() >= scene::kMaxInstances)
            throw Error(
                render::message<"limit.instances/models">("most"_arg = scene::kMaxInstances),
                model.where);
        const int number = static_cast<int>(numbers_.size()) + 1;
        objects_.push_back({&model, node, numbers_.emplace(&model, number).first->second,
                            meshes.get(model, *prepared_.assets)});
    }
    for (const scene::Group& child : group.groups) visit(child, node, meshes);
}

glm::dmat4 Inventory::matrix(int node, int ancestor, double timeS) const {
    glm::dmat4 out(1.0);
    for (int at = node; at != ancestor; at = nodes_[static_cast<std::size_t>(at)].parent) {
        const Node& one = nodes_[static_cast<std::size_t>(at)];
        out = scene::matrixAt(one.group->transforms, timeS) * one.copy * out;
    }
    return out;
}

bool Inventory::isBelow(int node, int ancestor) const {
    for (int at = node; at >= 0; at = nodes_[static_cast<std::size_t>(at)].parent)
        if (at == ancestor) return true;
    return ancestor < 0;
}

int Inventory::commonOf(int a, int b) const {
    while (a != b) {
        if (a < 0 || b < 0) return -1;
        // Children have higher numbers than their parents.
        int& lower = a > b ? a : b;
        lower = nodes_[static_cast<std::size_t>(lower)].parent;
    }
    return a;
}

glm::dvec3 Inventory::middle(std::size_t object, int ancestor, double timeS) const {
    const Object& one = objects_[object];
    const render::Box& box = one.mesh->bounds;
    const glm::dvec3 local =
        box.empty() ? glm::dvec3(0.0) : one.mesh->mesh.origin() + 0.5 * (box.min + box.max);
    return glm::dvec3(matrix(one.node, ancestor, timeS) * glm::dvec4(local, 1.0));
}

double Inventory::radius(std::size_t object, double timeS) const {
    const Object& one = objects_[object];
    const render::Box& box = one.mesh->bounds;
    if (box.empty()) return 0.0;
    const glm::dmat4 world = matrix(one.node, -1, timeS);
    const glm::dvec3 half = 0.5 * (box.max - box.min);
    double most = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        most = std::max(most, half[axis] * glm::length(glm::dvec3(world[axis])));
    return most;
}

std::vector<double> Inventory::periodsAbove(int node) const {
    std::set<double> periods;
    for (int at = node; at >= 0; at = nodes_[static_cast<std::size_t>(at)].parent)
        for (const scene::Transform& transform :
             nodes_[static_cast<std::size_t>(at)].group->transforms) {
            if (const auto* spin = std::get_if<scene::Spin>(&transform))
                periods.insert(std::abs(spin->seconds));
            if (const auto* curve = std::get_if<scene::FollowCurve>(&transform))
                periods.insert(curve->seconds);
        }
    return {periods.begin(), periods.end()};
}

const std::string& Inventory::shapeOf(std::size_t object) const {
    const Object& one = objects_[object];
    const auto known = shapes_.find(one.model);
    if (known != shapes_.end()) return known->second;
    return shapes_.emplace(one.model, formOf(*one.model, one.mesh->mesh, scene(), assets()))
        .first->second;
}

const std::string& Inventory::imageOf(std::size_t object) const {
    static const std::string kNone;
    const std::optional<scene::Texture>& texture = objects_[object].model->texture;
    if (!texture || texture->path.empty()) return kNone;
    const auto known = images_.find(texture->path);
    if (known != images_.end()) return known->second;
    std::string digest;
    try {
        if (const std::optional<std::string> bytes = assets().read(texture->path)) {
            image::imageSize(*bytes, texture->path);
            digest = contentDigest(*bytes);
        }
    } catch (const Error&) {  // the diagnostics have it; here it is an image that is not there
        digest.clear();
    }
    return images_.emplace(texture->path, std::move(digest)).first->second;
}

scene::Material Inventory::materialOf(std::size_t object) const {
    return objects_[object].model->material.value_or(scene::defaultMaterial(scene().dialect));
}

Message Inventory::nameOf(std::size_t object) const {
    const Object& one = objects_[object];
    for (const std::string* name : {&one.model->name, &one.model->id})
        if (!name->empty()) return requirementMessage<"part.object/name">("name"_arg = *name);
    for (int at = one.node; at >= 0; at = nodes_[static_cast<std::size_t>(at)].parent)
        if (const std::string& name = nodes_[static_cast<std::size_t>(at)].group->name;
            !name.empty())
            return requirementMessage<"part.object/group">(
                "group"_arg = name, "number"_arg = one.number, "shape"_arg = shapeOf(object));
    return requirementMessage<"part.object/number">("number"_arg = one.number,
                                                    "shape"_arg = shapeOf(object));
}

}  // namespace farol::grade
