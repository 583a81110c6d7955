#include "render/placeholders.h"

#include <functional>
#include <map>
#include <optional>

#include "generator/registry.h"
#include "image/image_file.h"
#include "render/plan/messages.h"

namespace farol::render {
namespace {

/// Magenta and black: colours that stand out from most textures.
constexpr scene::Chess kChecker{8, 8, glm::vec3(1.0F, 0.0F, 1.0F), glm::vec3(0.0F)};

class PlaceholderFiller {
  public:
    PlaceholderFiller(scene::Scene& scene, const scene::Assets& assets, Diagnostics& diagnostics)
        : scene_(scene), assets_(assets), diagnostics_(diagnostics) {}

    void run() {
        isMarked_ = !scene_.lights.empty();
        for (const scene::Group& group : scene_.groups) lookForColors(group);
        for (scene::Group& group : scene_.groups) visit(group);
        if (!hasImage(scene_.background.path, scene_.background.where)) {
            scene_.background.file.clear();
            scene_.background.path.clear();
        }
        if (scene_.skybox && !hasImage(scene_.skybox->path, scene_.skybox->where))
            scene_.skybox.reset();
    }

  private:
    /// A scene without lights and colours is drawn as lines, which a checker would end.
    void lookForColors(const scene::Group& group) {
        isMarked_ = isMarked_ || !group.lights.empty();
        for (const scene::Model& model : group.models)
            isMarked_ = isMarked_ || model.material || model.texture;
        for (const scene::Group& child : group.groups) lookForColors(child);
    }

    void visit(scene::Group& group) {
        for (scene::Model& model : group.models) {
            if (!hasMesh(model)) becomeBox(model);
            if (model.texture && !model.texture->chess &&
                !hasImage(model.texture->path, model.texture->where)) {
                model.texture->path.clear();
                model.texture->chess = kChecker;
            }
        }
        for (scene::Group& child : group.groups) visit(child);
    }

    /// Calls `read` once for each key; a fault is reported at the first place that needs the file.
    bool isReadable(const std::string& key, const Location& where,
                    const std::function<void()>& read) {
        const auto [known, isNew] = readable_.try_emplace(key, true);
        if (!isNew) return known->second;
        try {
            read();
        } catch (const Error& error) {
            known->second = false;
            Diagnostic fault = error.primary();
            if (fault.where.line == 0) fault.where = where;
            diagnostics_.push_back(std::move(fault));
        }
        return known->second;
    }

    bool hasMesh(const scene::Model& model) {
        using Kind = scene::ModelSource::Kind;
        const scene::ModelSource& source = model.source;
        if (source.kind == Kind::none) return false;
        if (source.kind == Kind::shape && !source.shape.entry->takesFile) return true;
        const std::string key = source.kind == Kind::file
                                    ? "file " + source.path
                                    : "shape " + source.path + generator::textOf(source.shape);
        return isReadable(key, model.where, [&] { generator::load(model, assets_); });
    }

    bool hasImage(const std::string& path, const Location& where) {
        if (path.empty()) return false;
        return isReadable("image " + path, where, [&] {
            const auto bytes = assets_.read(path);
            if (!bytes)
                throw Error(message<"asset.missing/image-file">("file"_arg = uncut(path)), where);
            std::string damage;  // reported where it is drawn
            image::decodeImage(*bytes, path, where, &damage);
        });
    }

    void becomeBox(scene::Model& model) {
        model.source = {scene::ModelSource::Kind::shape, "", generator::parseCall({"box", "1"})};
        model.revolve.reset();
        model.uv = scene::UvLayout::face;
        if (!isMarked_) return;
        model.material.reset();
        scene::Texture& texture = model.texture.emplace();
        texture.chess = kChecker;
        texture.where = model.where;
    }

    scene::Scene& scene_;
    const scene::Assets& assets_;
    Diagnostics& diagnostics_;
    std::map<std::string, bool> readable_;
    bool isMarked_ = false;
};

}  // namespace

void fillPlaceholders(scene::Scene& scene, const scene::Assets& assets, Diagnostics& diagnostics) {
    PlaceholderFiller(scene, assets, diagnostics).run();
    if (scene.entity) fillPlaceholders(*scene.entity, assets, diagnostics);
}

}  // namespace farol::render
