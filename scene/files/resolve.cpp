#include "scene/files/resolve.h"

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "core/text.h"

namespace farol::scene {
namespace {

class FileResolver {
  public:
    FileResolver(Scene& scene, Locator& locator, const FindSource& findSource,
                 Diagnostics& diagnostics)
        : scene_(scene), locator_(locator), findSource_(findSource), diagnostics_(diagnostics) {}

    void run() {
        for (Group& group : scene_.groups) visit(group);
        if (!scene_.background.file.empty())
            resolveFile(scene_.background.file, scene_.background.path, "background",
                        scene_.background.where);
        if (scene_.skybox)
            resolveFile(scene_.skybox->file, scene_.skybox->path, "skybox texture",
                        scene_.skybox->where);
    }

  private:
    void visit(Group& group) {
        for (Model& model : group.models) {
            resolveModel(model);
            // In the 2017 engines a plane has a second face that looks down.
            if (scene_.dialect == Dialect::engine2017 && model.source.isSheet)
                model.twoSided = true;
            if (model.texture && !model.texture->chess)
                resolveFile(model.texture->file, model.texture->path, "texture",
                            model.texture->where);
        }
        for (Group& child : group.groups) visit(child);
    }

    void reportError(const std::string& code, const Location& where, const std::string& message) {
        diagnostics_.push_back({Severity::error, code, where, message, ""});
    }

    /// What was found once holds for every model and texture of the same words in a document:
    /// asking the bundle again would repeat its warnings. What is missing is reported at each
    /// place.
    void resolveFile(const std::string& file, std::string& path, const std::string& what,
                     const Location& where) {
        const auto [known, fresh] = files_.try_emplace({where.file, file});
        if (fresh) {
            known->second.path = locator_.locate(file, where, diagnostics_);
            if (!known->second.path) known->second.advice = locator_.advice(file, where);
        }
        if (known->second.path)
            path = *known->second.path;
        else
            reportError("asset.missing", where,
                        "there is no " + what + " " + quoted(file) + known->second.advice);
    }

    void resolveModel(Model& model) {
        const auto [known, fresh] = models_.try_emplace(
            {model.where.file, model.file, model.command, model.revolve.value_or(0)});
        if (fresh) {
            try {
                known->second.source = findSource_(model);
            } catch (const Error& error) {
                known->second.fault = error.primary();
            }
        }
        if (known->second.fault)
            reportError(known->second.fault->code, model.where, known->second.fault->message);
        else
            model.source = known->second.source;
    }

    struct FoundFile {
        std::optional<std::string> path;
        std::string advice;
    };
    struct FoundModel {
        ModelSource source;
        std::optional<Diagnostic> fault;
    };

    Scene& scene_;
    Locator& locator_;
    const FindSource& findSource_;
    Diagnostics& diagnostics_;
    /// By the document and the words in it.
    std::map<std::pair<std::string, std::string>, FoundFile> files_;
    std::map<std::tuple<std::string, std::string, std::string, int>, FoundModel> models_;
};

}  // namespace

void resolveFiles(Scene& scene, Locator& locator, const FindSource& findSource,
                  Diagnostics& diagnostics) {
    FileResolver(scene, locator, findSource, diagnostics).run();
}

}  // namespace farol::scene
