#include "scene/files/resolve.h"

#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "core/text.h"
#include "scene/messages.h"

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
            resolveFile(scene_.background.file, scene_.background.path, Use::background,
                        scene_.background.where);
        if (scene_.skybox)
            resolveFile(scene_.skybox->file, scene_.skybox->path, Use::skybox,
                        scene_.skybox->where);
    }

  private:
    enum class Use { texture, background, skybox };

    void visit(Group& group) {
        for (Model& model : group.models) {
            resolveModel(model);
            // In the 2017 engines a plane has a second face that looks down.
            if (scene_.dialect == Dialect::engine2017 && model.source.isSheet)
                model.twoSided = true;
            if (model.texture && !model.texture->chess)
                resolveFile(model.texture->file, model.texture->path, Use::texture,
                            model.texture->where);
        }
        for (Group& child : group.groups) visit(child);
    }

    static Message missing(Use use, const std::string& file, const Message& fix) {
        switch (use) {
            case Use::background:
                return message<"asset.missing/background">("file"_arg = file, "fix"_arg = fix);
            case Use::skybox:
                return message<"asset.missing/skybox">("file"_arg = file, "fix"_arg = fix);
            case Use::texture:
                break;
        }
        return message<"asset.missing/texture">("file"_arg = file, "fix"_arg = fix);
    }

    /// Looks up each file name of a document once, because a second look-up would repeat the
    /// locator's warnings, and stores the result in files_. Reports a missing file at each place
    /// that names it.
    void resolveFile(const std::string& file, std::string& path, Use use, const Location& where) {
        const auto [known, fresh] = files_.try_emplace({where.file, file});
        if (fresh) {
            known->second.path = locator_.locate(file, where, diagnostics_);
            if (!known->second.path) known->second.advice = locator_.advice(file, where);
        }
        if (known->second.path)
            path = *known->second.path;
        else
            diagnostics_.push_back(
                diagnosticOf(Severity::error, missing(use, file, known->second.advice), where));
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
        if (!known->second.fault) {
            model.source = known->second.source;
            return;
        }
        Diagnostic fault = *known->second.fault;
        fault.where = model.where;
        diagnostics_.push_back(std::move(fault));
    }

    struct FoundFile {
        std::optional<std::string> path;
        Message advice;
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
