#include "render/prepare.h"

#include <algorithm>
#include <cctype>

#include "generator/registry.h"
#include "scene/reader.h"

namespace farol::render {
namespace {

/// The job's own document in front of its assets, so that a mesh file alone can be loaded.
class WithDocument final : public scene::Assets {
  public:
    WithDocument(const std::string& name, std::string bytes,
                 std::shared_ptr<const scene::Assets> rest)
        : document_(std::map<std::string, std::string>{{name, std::move(bytes)}}),
          rest_(std::move(rest)) {}
    std::vector<std::string> list() const override {
        std::vector<std::string> all = rest_->list();
        for (std::string& name : document_.list()) all.push_back(std::move(name));
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        return all;
    }
    bool has(const std::string& path) const override {
        return document_.has(path) || rest_->has(path);
    }
    std::optional<std::string> read(const std::string& path) const override {
        return document_.has(path) ? document_.read(path) : rest_->read(path);
    }
    std::string version(const std::string& path) const override {
        return document_.has(path) ? document_.version(path) : rest_->version(path);
    }

  private:
    scene::BundleAssets document_;
    std::shared_ptr<const scene::Assets> rest_;
};

std::string ending(const std::string& name) {
    const std::size_t dot = name.rfind('.');
    std::string text = dot == std::string::npos ? "" : name.substr(dot + 1);
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// A mesh on its own, in daylight that comes with the viewer.
scene::Scene sceneOfMesh(const std::string& name) {
    scene::Scene scene;
    scene::Light light;
    light.type = scene::LightType::directional;
    light.space = scene::LightSpace::camera;
    light.direction = glm::dvec3(0.3, 0.4, 1.0);
    scene.lights.push_back(light);
    scene::Model model;
    if (ending(name) == "patch")
        model.command = "patch " + name + " 10";
    else
        model.file = name;
    model.material = scene::Material{};
    model.where.file = name;
    scene.groups.emplace_back().models.push_back(std::move(model));
    return scene;
}

void refuseErrors(Diagnostics& diagnostics, bool strict) {
    if (strict)
        for (Diagnostic& one : diagnostics)
            if (one.severity == Severity::warning) one.severity = Severity::error;
    if (std::any_of(diagnostics.begin(), diagnostics.end(),
                    [](const Diagnostic& one) { return one.severity == Severity::error; }))
        throw Error(diagnostics);
}

}  // namespace

Prepared prepare(const Job& job) {
    Prepared prepared;
    prepared.assets = job.assets ? job.assets : std::make_shared<scene::BundleAssets>();
    const std::string kind = ending(job.name);
    if (kind == "3d" || kind == "obj" || kind == "ply" || kind == "tri" || kind == "patch") {
        const std::string base = job.name.substr(job.name.find_last_of("/\\") + 1);
        prepared.scene = sceneOfMesh(base);
        prepared.assets = std::make_shared<WithDocument>(base, job.xml, prepared.assets);
    } else {
        scene::ReadOptions options;
        options.name = job.name;
        options.strict = job.strict;
        scene::ReadResult result = scene::read(job.xml, options, *prepared.assets);
        prepared.scene = std::move(result.scene);
        prepared.diagnostics = std::move(result.diagnostics);
    }
    generator::resolve(prepared.scene, *prepared.assets, prepared.diagnostics);
    refuseErrors(prepared.diagnostics, job.strict);
    return prepared;
}

}  // namespace farol::render
