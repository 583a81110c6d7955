#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <regex>

#include "classroom.h"
#include "image/format.h"
#include "image/image_file.h"
#include "scene/write/writer.h"

namespace farol::test {
namespace {

using Result = std::optional<std::string>;

Result written(const Work& work) { return scene::write(work.scene); }

Result canonical(Work& work) { return written(work); }

/// Every tag's attributes in the other order.
Result attributeOrder(Work& work) {
    const std::string xml = scene::write(work.scene);
    static const std::regex kTag("<([A-Za-z]+)((?: +[A-Za-z:]+=\"[^\"]*\")+)( */?>)");
    static const std::regex kAttribute(" +[A-Za-z:]+=\"[^\"]*\"");
    std::string out;
    auto rest = xml.cbegin();
    for (std::sregex_iterator tag(xml.begin(), xml.end(), kTag), end; tag != end; ++tag) {
        out.append(rest, (*tag)[0].first);
        const std::string attributes = (*tag)[2];
        std::string turned;
        for (std::sregex_iterator one(attributes.begin(), attributes.end(), kAttribute);
             one != std::sregex_iterator(); ++one)
            turned = one->str() + turned;
        out += "<" + (*tag)[1].str() + turned + (*tag)[3].str();
        rest = (*tag)[0].second;
    }
    out.append(rest, xml.cend());
    return out;
}

/// Names of elements and attributes in capitals.
Result namesCase(Work& work) {
    std::string xml = scene::write(work.scene);
    bool tag = false, value = false;
    for (std::size_t i = 0; i < xml.size(); ++i) {
        if (!value && xml[i] == '<') tag = xml.compare(i, 2, "<?") != 0 && xml[i + 1] != '!';
        if (!value && xml[i] == '>') tag = false;
        if (tag && xml[i] == '"') value = !value;
        if (tag && !value)
            xml[i] = static_cast<char>(std::toupper(static_cast<unsigned char>(xml[i])));
    }
    return xml;
}

/// Each group's transforms in nested groups, each rotation in two halves.
Result equivalentTransforms(Work& work) {
    bool any = false;
    const std::function<void(scene::Group&)> visit = [&](scene::Group& group) {
        for (scene::Group& child : group.groups) visit(child);
        if (group.transforms.empty() || group.scatter) return;
        std::vector<scene::Transform> all;
        for (const scene::Transform& transform : group.transforms) {
            const auto* rotate = std::get_if<scene::Rotate>(&transform);
            all.push_back(
                rotate ? scene::Transform(scene::Rotate{rotate->angleDeg * 0.5, rotate->axis})
                       : transform);
            if (rotate) all.push_back(all.back());
        }
        scene::Group inner = group;
        inner.transforms = {all.back()};
        inner.transformsAt.clear();
        for (std::size_t i = all.size() - 1; i-- > 0;) {
            scene::Group outer;
            outer.transforms = {all[i]};
            outer.groups.push_back(std::move(inner));
            inner = std::move(outer);
        }
        group = std::move(inner);
        any = true;
    };
    for (scene::Group& group : work.scene.groups) visit(group);
    return any ? written(work) : Result();
}

Result unnormalised(Work& work) {
    bool any = false;
    for (scene::Light& light : work.scene.lights) {
        light.direction *= 2.5;
        any = any || light.direction != glm::dvec3(0.0);
    }
    for (scene::Group* group : groupsOf(work.scene))
        for (scene::Transform& transform : group->transforms)
            if (auto* rotate = std::get_if<scene::Rotate>(&transform)) {
                rotate->axis *= 3.0;
                any = true;
            }
    return any ? written(work) : Result();
}

template <typename Change>
Result allMeshes(Work& work, const char* ending, Change change) {
    int count = 0;
    for (const Placed& one : modelsOf(work.scene))
        if (replaceMesh(work, *one.model, "mesh" + std::to_string(count) + ending, change)) ++count;
    return count > 0 ? written(work) : Result();
}

Result otherFormat(Work& work) {
    return allMeshes(work, ".ply", [](generator::MeshArrays&) {});
}

Result otherOrder(Work& work) {
    return allMeshes(work, ".obj", [](generator::MeshArrays& mesh) {
        std::reverse(mesh.indices.begin(), mesh.indices.end());
        for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3)
            std::swap(mesh.indices[t], mesh.indices[t + 1]);
    });
}

/// The camera turned by less than a pixel of the usual pictures, as rounding its numbers does.
Result pixelShift(Work& work) {
    if (!work.scene.camera) return {};
    scene::Camera& camera = *work.scene.camera;
    const glm::dvec3 view = camera.target - camera.eye;
    const glm::dvec3 right = glm::normalize(glm::cross(view, camera.up));
    const double pixel = 2.0 * std::tan(glm::radians(camera.fovDeg) / 2.0) / 384.0;
    camera.target += right * glm::length(view) * pixel * 0.9;
    return written(work);
}

Result antialiasing(Work& work) {
    work.scene.settings.samples = 8;
    return written(work);
}

Result siblings(Work& work) {
    if (work.scene.groups.size() < 2) return {};
    std::reverse(work.scene.groups.begin(), work.scene.groups.end());
    return written(work);
}

/// Every model in a separate group.
Result splitGroups(Work& work) {
    bool any = false;
    const std::function<void(scene::Group&)> visit = [&](scene::Group& group) {
        for (scene::Group& child : group.groups) visit(child);
        if (group.scatter || group.models.empty()) return;
        for (std::size_t i = group.models.size(); i-- > 0;) {
            scene::Group own;
            own.models.push_back(group.models[i]);
            group.groups.insert(group.groups.begin(), std::move(own));
        }
        group.models.clear();
        any = true;
    };
    for (scene::Group& group : work.scene.groups) visit(group);
    return any ? written(work) : Result();
}

Result wholeTurns(Work& work) {
    bool any = false;
    for (scene::Group* group : groupsOf(work.scene))
        for (scene::Transform& transform : group->transforms)
            if (auto* rotate = std::get_if<scene::Rotate>(&transform)) {
                rotate->angleDeg -= 360.0;
                any = true;
            }
    return any ? written(work) : Result();
}

Result pictureFormat(Work& work) {
    bool any = false;
    for (const Placed& one : modelsOf(work.scene)) {
        auto& texture = one.model->texture;
        if (!texture || texture->path.empty()) continue;
        const std::string name = "again-" + texture->path + ".png";
        work.files[name] =
            image::encodePng(image::decodeImage(work.files.at(texture->path), texture->path));
        texture->file = name;
        any = true;
    }
    return any ? written(work) : Result();
}

}  // namespace

std::vector<Variant> harmless() {
    return {
        {"written another way", {}, canonical},
        {"order of attributes", {}, attributeOrder},
        {"names in capitals", {}, namesCase},
        {"equivalent transforms", {}, equivalentTransforms},
        {"directions of any length", {}, unnormalised},
        {"meshes in another format", {}, otherFormat},
        {"triangles in another order", {}, otherOrder},
        {"a pixel's shift by rounding", {}, pixelShift},
        {"antialiasing", {}, antialiasing},
        {"order of groups", {}, siblings},
        {"groups split", {}, splitGroups},
        {"angles and whole turns", {}, wholeTurns},
        {"textures in another format", {}, pictureFormat},
    };
}

}  // namespace farol::test
