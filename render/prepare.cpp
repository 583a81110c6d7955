#include "render/prepare.h"

#include <algorithm>
#include <iterator>

#include "core/messages.h"
#include "core/text.h"
#include "generator/registry.h"
#include "render/placeholders.h"
#include "render/plan/messages.h"
#include "scene/animation.h"
#include "scene/files/archive.h"
#include "scene/files/locator.h"
#include "scene/read/reader.h"

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
    std::optional<std::uint64_t> size(const std::string& path) const override {
        return document_.has(path) ? document_.size(path) : rest_->size(path);
    }
    void prefetch(const std::vector<std::string>& paths) const override { rest_->prefetch(paths); }
    std::string version(const std::string& path) const override {
        return document_.has(path) ? document_.version(path) : rest_->version(path);
    }

  private:
    scene::BundleAssets document_;
    std::shared_ptr<const scene::Assets> rest_;
};

/// A mesh on its own, in daylight that comes with the viewer.
scene::Scene sceneOfMesh(const std::string& name) {
    scene::Scene scene;
    scene::Light light;
    light.type = scene::LightType::directional;
    light.space = scene::LightSpace::camera;
    light.direction = glm::dvec3(0.3, 0.4, 1.0);
    scene.lights.push_back(light);
    scene::Model model;
    if (fileEnding(name) == "patch")
        model.command = "patch " + name + " 10";
    else
        model.file = name;
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
    Job job = packed;
    const auto files = std::make_shared<const scene::ArchiveAssets>(
        std::make_shared<std::string>(std::move(job.archive)));
    job.archive.clear();
    job.name = job.path = scene::mainOf(*files);
    job.xml = files->read(job.path).value_or("");
    job.assets = files;
    return job;
}

/// Adds the files that the scene takes.
void addFiles(const scene::Group& group, std::vector<std::string>& paths) {
    for (const scene::Model& model : group.models) {
        if (!model.source.path.empty()) paths.push_back(model.source.path);
        if (model.texture && !model.texture->path.empty()) paths.push_back(model.texture->path);
    }
    for (const scene::Group& child : group.groups) addFiles(child, paths);
}

void addFiles(const scene::Scene& scene, std::vector<std::string>& paths) {
    for (const scene::Group& group : scene.groups) addFiles(group, paths);
    if (!scene.background.path.empty()) paths.push_back(scene.background.path);
    if (scene.skybox && !scene.skybox->path.empty()) paths.push_back(scene.skybox->path);
    if (scene.entity) addFiles(*scene.entity, paths);
}

/// The request's entity, in place of the scene's.
void takeEntity(Prepared& prepared, const std::string& file) {
    const auto path =
        scene::locate(*prepared.assets, file, {}, prepared.diagnostics, prepared.scene.document);
    if (!path) throw Error(message<"option.range/entity">("value"_arg = uncut(file)), {}, "entity");
    scene::ReadOptions options;
    options.name = options.path = *path;
    scene::ReadResult result =
        scene::read(prepared.assets->read(*path).value_or(""), options, *prepared.assets);
    prepared.scene.entity = std::make_shared<scene::Scene>(std::move(result.scene));
    for (Diagnostic& one : result.diagnostics) prepared.diagnostics.push_back(std::move(one));
}

constexpr std::size_t kMaxFindings = 2'000;

/// Keeps errors before the rest, in their order, and adds how many were dropped.
void capFindings(Diagnostics& diagnostics) {
    if (diagnostics.size() <= kMaxFindings) return;
    const std::size_t kept = kMaxFindings - 1;
    std::vector<bool> isKept(diagnostics.size());
    std::size_t count = 0;
    for (const bool errors : {true, false})
        for (std::size_t i = 0; i < diagnostics.size() && count < kept; ++i)
            if ((diagnostics[i].severity == Severity::error) == errors) {
                isKept[i] = true;
                ++count;
            }
    const std::size_t hidden = diagnostics.size() - kept;
    Diagnostics shown;
    for (std::size_t i = 0; i < diagnostics.size(); ++i)
        if (isKept[i]) shown.push_back(std::move(diagnostics[i]));
    shown.push_back(
        diagnosticOf(Severity::info, coreMessage<"limit.diagnostics">("count"_arg = hidden)));
    diagnostics = std::move(shown);
}

}  // namespace

void refuseErrors(Diagnostics& diagnostics, const Job& job) {
    if (job.strict)
        for (Diagnostic& one : diagnostics)
            if (one.severity == Severity::warning) one.severity = Severity::error;
    capFindings(diagnostics);
    if (job.options.missing == Missing::placeholder) return;
    if (std::any_of(diagnostics.begin(), diagnostics.end(),
                    [](const Diagnostic& one) { return one.severity == Severity::error; }))
        throw Error(diagnostics);
}

namespace {

/// Adds errors of missing files to those of an unreadable document.
void addMissingFiles(Diagnostics& errors, const Job& job, scene::ReadOptions options,
                     const scene::Assets& assets) {
    options.leaveOut = true;
    scene::Scene readable;
    try {
        readable = scene::read(job.xml, options, assets).scene;
    } catch (const Error&) {
        return;  // the errors of the document are already in the list
    }
    Diagnostics findings;
    generator::resolve(readable, assets, findings);
    for (Diagnostic& finding : findings)
        if (finding.severity == Severity::error && finding.code == "asset.missing")
            errors.push_back(std::move(finding));
}

/// Throws Error with the missing files too.
scene::ReadResult readScene(const Job& job, const scene::Assets& assets) {
    scene::ReadOptions options;
    options.name = job.name;
    options.path = job.path;
    options.strict = job.strict;
    options.leaveOut = job.options.missing == Missing::placeholder;
    try {
        return scene::read(job.xml, options, assets);
    } catch (const Error& error) {
        if (options.leaveOut) throw;
        Diagnostics errors = error.diagnostics();
        addMissingFiles(errors, job, options, assets);
        capFindings(errors);
        throw Error(std::move(errors));
    }
}

}  // namespace

Prepared prepare(const Job& job) {
    if (!job.archive.empty()) return prepare(unpacked(job));
    Prepared prepared;
    if (const auto* archive = dynamic_cast<const scene::ArchiveAssets*>(job.assets.get()))
        prepared.diagnostics = archive->findings();
    prepared.assets = job.assets ? job.assets : std::make_shared<scene::BundleAssets>();
    const std::string kind = fileEnding(job.name);
    if (generator::isMeshName(job.name) || kind == "patch") {
        const std::string base = job.name.substr(job.name.find_last_of("/\\") + 1);
        prepared.scene = sceneOfMesh(base);
        prepared.assets = std::make_shared<WithDocument>(base, job.xml, prepared.assets);
        scene::Model& model = prepared.scene.groups[0].models[0];
        model.source = {scene::ModelSource::Kind::file, base};
        if (kind == "ply" && isProfile(model, *prepared.assets)) {
            model.revolve = kProfileCopies;
            model.twoSided = true;
        }
        model.source = {};
    } else {
        scene::ReadResult result = readScene(job, *prepared.assets);
        prepared.scene = std::move(result.scene);
        std::move(result.diagnostics.begin(), result.diagnostics.end(),
                  std::back_inserter(prepared.diagnostics));
    }
    if (job.options.entity) takeEntity(prepared, *job.options.entity);
    generator::resolve(prepared.scene, *prepared.assets, prepared.diagnostics);
    if (job.options.missing == Missing::placeholder && prepared.scene.where.line > 0)
        fillPlaceholders(prepared.scene, *prepared.assets, prepared.diagnostics);
    refuseErrors(prepared.diagnostics, job);
    std::vector<std::string> files;
    addFiles(prepared.scene, files);
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    prepared.assets->prefetch(files);
    prepared.animated = scene::isAnimated(prepared.scene) ||
                        (prepared.scene.entity && scene::isAnimated(*prepared.scene.entity));
    return prepared;
}

std::shared_ptr<const Prepared> PreparedCache::get(const Job& job) {
    if (job.identity.empty()) return std::make_shared<const Prepared>(prepare(job));
    const std::string key =
        job.identity + '\n' + job.name + '\n' + job.path + '\n' + (job.strict ? 's' : 'l') +
        std::string(kMissingWords[job.options.missing]) + '\n' + job.options.entity.value_or("");
    if (const auto* known = kept_.find(key)) return *known;
    auto fresh = std::make_shared<const Prepared>(prepare(job));
    std::size_t cost = 1;
    if (const auto* bundle = dynamic_cast<const scene::BundleAssets*>(fresh->assets.get()))
        cost += bundle->bytes() / kBytesOfOne;  // its files are kept with it
    if (const auto* archive = dynamic_cast<const scene::ArchiveAssets*>(fresh->assets.get()))
        cost += archive->maxBytes() / kBytesOfOne;
    return kept_.put(key, std::move(fresh), cost);
}

}  // namespace farol::render
