#include <functional>
#include <map>

#include "generator/io/mesh_file.h"
#include "grade/requirements/facts.h"
#include "scene/files/assets.h"

namespace farol::grade {
namespace {

constexpr const char* kFolder = ".one-normal/";

/// The files of a scene, and further meshes.
class MoreAssets final : public scene::Assets {
  public:
    MoreAssets(std::shared_ptr<const scene::Assets> own, scene::BundleAssets::Files more)
        : own_(std::move(own)), more_(std::move(more)) {}

    std::vector<std::string> list() const override { return own_->list(); }
    bool has(const std::string& path) const override { return of(path).has(path); }
    std::optional<std::string> read(const std::string& path) const override {
        return of(path).read(path);
    }
    std::optional<std::uint64_t> size(const std::string& path) const override {
        return of(path).size(path);
    }
    std::string version(const std::string& path) const override { return of(path).version(path); }

  private:
    const scene::Assets& of(const std::string& path) const {
        return path.starts_with(kFolder) ? static_cast<const scene::Assets&>(more_) : *own_;
    }
    std::shared_ptr<const scene::Assets> own_;
    scene::BundleAssets more_;
};

void eachGroup(std::vector<scene::Group>& groups, const std::function<void(scene::Group&)>& visit) {
    for (scene::Group& group : groups) {
        visit(group);
        eachGroup(group.groups, visit);
    }
}

void darken(scene::Light& light) {
    light.diffuse = light.ambient = light.specular = scene::Color{};
}

/// Gives every model a mesh whose normals all point up.
void takeNormals(render::Prepared& scene, const Inventory& inventory) {
    std::map<std::uint64_t, std::string> paths;  // by mesh
    std::map<int, std::string> pathOf;           // by number of the model
    scene::BundleAssets::Files files;
    for (const Inventory::Object& object : inventory.objects()) {
        std::string& path = paths[object.mesh->id];
        if (path.empty() && !object.mesh->mesh.indices().empty()) {
            path = kFolder + std::to_string(paths.size()) + ".3db";
            generator::MeshArrays arrays = object.mesh->mesh.arrays();
            arrays.normals.assign(arrays.positions.size(), glm::vec3(0, 1, 0));
            files[path] = generator::io::encodeMesh(generator::Mesh(std::move(arrays)),
                                                    generator::io::Format::binary);
        }
        pathOf[object.number] = path;
    }
    int number = 0;
    eachGroup(scene.scene.groups, [&](scene::Group& group) {
        for (scene::Model& model : group.models) {
            const auto found = pathOf.find(++number);
            if (found == pathOf.end() || found->second.empty()) continue;
            const bool isSheet = model.source.isSheet;
            auto materials = model.source.materials;
            model.source = {scene::ModelSource::Kind::file, found->second};
            model.source.isSheet = isSheet;
            model.source.materials = std::move(materials);
            model.autoLod = false;
        }
    });
    scene.assets = std::make_shared<const MoreAssets>(scene.assets, std::move(files));
}

}  // namespace

std::shared_ptr<const render::Prepared> without(const render::Prepared& prepared,
                                                const Inventory& inventory, Effect effect) {
    auto out = std::make_shared<render::Prepared>(prepared);
    switch (effect) {
        case Effect::light:
            for (scene::Light& light : out->scene.lights) darken(light);
            eachGroup(out->scene.groups, [](scene::Group& group) {
                for (scene::Light& light : group.lights) darken(light);
            });
            break;
        case Effect::texture:
            eachGroup(out->scene.groups, [](scene::Group& group) {
                for (scene::Model& model : group.models) model.texture.reset();
            });
            break;
        case Effect::normals:
            takeNormals(*out, inventory);
            break;
    }
    return out;
}

std::shared_ptr<const render::Prepared> withoutLight(const render::Prepared& prepared, int light) {
    auto out = std::make_shared<render::Prepared>(prepared);
    int number = 0;
    const auto visit = [&](std::vector<scene::Light>& lights) {
        for (scene::Light& one : lights)
            if (number++ == light) darken(one);
    };
    visit(out->scene.lights);
    eachGroup(out->scene.groups, [&](scene::Group& group) { visit(group.lights); });
    return out;
}

}  // namespace farol::grade
