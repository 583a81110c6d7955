#include "render/prepare.h"

#include <algorithm>
#include <cctype>

#include "generator/registry.h"
#include "scene/animation.h"
#include "scene/archive.h"
#include "scene/reader.h"

namespace farol::render {
namespace {

constexpr std::size_t kBytesOfOne = std::size_t{4} << 20;  // of files, that count as a scene
constexpr int kProfileCopies = 65;                         // of a profile shown on its own

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

/// A PLY profile has vertices but no faces; on its own it is shown turned about Y.
bool isProfile(const scene::Model& model, const scene::Assets& assets) {
    try {
        generator::load(model, assets);
    } catch (const Error& error) {
        return error.code() == "mesh.empty";
    }
    return false;
}

/// The job that an archive holds.
Job unpacked(const Job& packed) {
    scene::Bundle bundle = scene::readArchive(packed.archive);
    Job job = packed;
    job.archive.clear();
    job.name = bundle.main;
    job.xml = bundle.files[bundle.main];
    job.assets = std::make_shared<scene::BundleAssets>(std::move(bundle.files));
    return job;
}

/// The request's entity, in place of the scene's.
void takeEntity(Prepared& prepared, const std::string& file) {
    const auto path = scene::locate(*prepared.assets, file, {}, prepared.diagnostics);
    if (!path)
        throw Error("option.range", "entity=" + file + " is no file of this scene", {}, "entity");
    scene::ReadOptions options;
    options.name = *path;
    scene::ReadResult result =
        scene::read(prepared.assets->read(*path).value_or(""), options, *prepared.assets);
    prepared.scene.entity = std::make_shared<scene::Scene>(std::move(result.scene));
    for (Diagnostic& one : result.diagnostics) prepared.diagnostics.push_back(std::move(one));
}

}  // namespace

void refuseErrors(Diagnostics& diagnostics, bool strict) {
    if (strict)
        for (Diagnostic& one : diagnostics)
            if (one.severity == Severity::warning) one.severity = Severity::error;
    if (std::any_of(diagnostics.begin(), diagnostics.end(),
                    [](const Diagnostic& one) { return one.severity == Severity::error; }))
        throw Error(diagnostics);
}

Prepared prepare(const Job& job) {
    if (!job.archive.empty()) return prepare(unpacked(job));
    Prepared prepared;
    prepared.assets = job.assets ? job.assets : std::make_shared<scene::BundleAssets>();
    const std::string kind = ending(job.name);
    if (generator::isMeshName(job.name) || kind == "patch") {
        const std::string base = job.name.substr(job.name.find_last_of("/\\") + 1);
        prepared.scene = sceneOfMesh(base);
        prepared.assets = std::make_shared<WithDocument>(base, job.xml, prepared.assets);
        scene::Model& model = prepared.scene.groups[0].models[0];
        model.source = {scene::ModelSource::Kind::file, base, {}};
        if (kind == "ply" && isProfile(model, *prepared.assets)) {
            model.revolve = kProfileCopies;
            model.twoSided = true;
        }
        model.source = {};
    } else {
        scene::ReadOptions options;
        options.name = job.name;
        options.strict = job.strict;
        scene::ReadResult result = scene::read(job.xml, options, *prepared.assets);
        prepared.scene = std::move(result.scene);
        prepared.diagnostics = std::move(result.diagnostics);
    }
    if (job.options.entity) takeEntity(prepared, *job.options.entity);
    generator::resolve(prepared.scene, *prepared.assets, prepared.diagnostics);
    refuseErrors(prepared.diagnostics, job.strict);
    prepared.animated = scene::isAnimated(prepared.scene) ||
                        (prepared.scene.entity && scene::isAnimated(*prepared.scene.entity));
    return prepared;
}

std::shared_ptr<const Prepared> PreparedCache::get(const Job& job) {
    if (job.identity.empty()) return std::make_shared<const Prepared>(prepare(job));
    const std::string key = job.identity + '\n' + job.name + '\n' + (job.strict ? 's' : 'l') +
                            job.options.entity.value_or("");
    if (const auto* known = kept_.find(key)) return *known;
    auto fresh = std::make_shared<const Prepared>(prepare(job));
    std::size_t cost = 1;
    if (const auto* bundle = dynamic_cast<const scene::BundleAssets*>(fresh->assets.get()))
        cost += bundle->bytes() / kBytesOfOne;  // its files are kept with it
    return kept_.put(key, std::move(fresh), cost);
}

}  // namespace farol::render
