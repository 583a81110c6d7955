#include <algorithm>
#include <map>
#include <tuple>

#include "generator/call.h"
#include "generator/registry.h"
#include "generator/sources.h"
#include "generator/words.h"
#include "scene/words.h"

namespace farol::generator {
namespace {

using scene::ModelSource;

/// The ending of a name, in lower case.
bool endsWith(const std::string& name, const std::string& ending) {
    if (name.size() < ending.size()) return false;
    for (std::size_t i = 0; i < ending.size(); ++i) {
        const char c = name[name.size() - ending.size() + i];
        if ((c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c) != ending[i]) return false;
    }
    return true;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

class Resolver {
  public:
    Resolver(scene::Scene& scene, const scene::Assets& assets, Diagnostics& diagnostics)
        : scene_(scene), assets_(assets), diagnostics_(diagnostics) {}

    void run() {
        for (scene::Group& group : scene_.groups) visit(group);
        if (!scene_.background.file.empty())
            resolveFile(scene_.background.file, scene_.background.path, "background",
                        scene_.background.where);
        if (scene_.skybox)
            resolveFile(scene_.skybox->file, scene_.skybox->path, "skybox texture",
                        scene_.skybox->where);
    }

  private:
    void visit(scene::Group& group) {
        for (scene::Model& model : group.models) {
            resolveModel(model);
            // In the 2017 engines a plane has a second face that looks down.
            if (scene_.dialect == scene::Dialect::engine2017 && !model.source.words.empty() &&
                model.source.words[0] == "plane")
                model.twoSided = true;
            if (model.texture && !model.texture->chess)
                resolveFile(model.texture->file, model.texture->path, "texture",
                            model.texture->where);
        }
        for (scene::Group& child : group.groups) visit(child);
    }

    void report(Severity severity, const std::string& code, const Location& where,
                const std::string& message) {
        diagnostics_.push_back({severity, code, where, message, ""});
    }

    /// What was found once holds for every model and texture of the same words: asking the
    /// bundle again would repeat its warnings. What is missing is reported at each place.
    void resolveFile(const std::string& file, std::string& path, const std::string& what,
                     const Location& where) {
        const auto [known, fresh] = files_.try_emplace(file);
        if (fresh) {
            known->second.path = scene::locate(assets_, file, where, diagnostics_);
            if (!known->second.path) known->second.hint = cure(file, {});
        }
        if (known->second.path)
            path = *known->second.path;
        else
            report(Severity::error, "asset.missing", where,
                   "there is no " + what + " \"" + file + "\"" + known->second.hint);
    }

    void resolveModel(scene::Model& model) {
        const auto [known, fresh] =
            models_.try_emplace({model.file, model.command, model.revolve.value_or(0)});
        if (fresh) {
            try {
                known->second.source = find(model);
            } catch (const Error& error) {
                known->second.fault = error.primary();
            }
        }
        if (known->second.fault.code.empty())
            model.source = known->second.source;
        else
            report(Severity::error, known->second.fault.code, model.where,
                   known->second.fault.message);
    }

    /// Throws Error where the model cannot be had.
    ModelSource find(const scene::Model& model) {
        if (model.revolve)
            return shape({"revolution", model.file, std::to_string(*model.revolve)}, model,
                         "a profile to revolve");
        const auto path = model.file.empty()
                              ? std::nullopt
                              : scene::locate(assets_, model.file, model.where, diagnostics_);
        if (path) {
            report(Severity::info, "asset.from-file", model.where,
                   "\"" + model.file + "\" is the file \"" + *path + "\"");
            if (endsWith(*path, ".patch"))
                return {ModelSource::Kind::shape, *path, {"patch", *path}};
            return {ModelSource::Kind::file, *path, {}};
        }
        if (!model.command.empty()) {
            const auto words =
                wordsOfComment(splitWords(model.command), "", model.where, diagnostics_);
            return shape(words, model, "its command");
        }
        const auto named = wordsOfName(model.file);
        if (const auto* words = comment(model.file))
            if (const auto taken = fromComment(*words, named, model)) return *taken;
        if (named) return fromName(*named, model);
        if (builtinFile(model.file))
            return shape({"patch", baseNameOf(model.file)}, model, "a built-in file");
        throw Error("asset.missing",
                    "there is no file \"" + model.file +
                        "\", no generator comment for it, and its name is no shape's" +
                        cure(model.file, shapeNames(model.file)));
    }

    /// A comment that makes no sense counts for nothing where the name itself says all.
    std::optional<ModelSource> fromComment(const std::vector<std::string>& words,
                                           const std::optional<std::vector<std::string>>& named,
                                           const scene::Model& model) {
        try {
            return shape(wordsOfComment(words, model.file, model.where, diagnostics_), model,
                         "its generator comment");
        } catch (const Error& error) {
            if (!named || named->size() < 2) throw;
            report(Severity::warning, error.code(), model.where,
                   std::string(error.what()) + "; the comment is not used, the file's name is");
            return std::nullopt;
        }
    }

    /// "sphere.3d" alone says no size: the unit one is taken, and said to be a guess.
    ModelSource fromName(std::vector<std::string> words, const scene::Model& model) {
        const Shape* named = findShape(words[0]);
        if (words.size() == 1 && named != nullptr) {
            for (std::size_t i = 0; i < named->required; ++i) words.push_back(unitOf(*named, i));
            report(Severity::warning, "shape.guessed", model.where,
                   "\"" + model.file + "\" does not exist and its name gives no size: \"" +
                       joined(words) + "\" is taken");
        }
        return shape(words, model, "its name");
    }

    /// Sizes that give every shape its usual form within about one unit.
    static std::string unitOf(const Shape& shape, std::size_t argument) {
        const bool second = argument == 1;
        if (shape.name == "torus" || shape.name == "frustum") return second ? "0.5" : "1";
        if (shape.name == "ring") return second ? "1" : "0.5";
        return "1";
    }

    ModelSource shape(const std::vector<std::string>& words, const scene::Model& model,
                      const std::string& why) {
        const Call call = parseCall(words);
        ModelSource source{ModelSource::Kind::shape, "", words};
        source.words[0] = call.shape->name;
        if (call.shape->takesFile) {
            if (const auto path = scene::locate(assets_, call.file, model.where, diagnostics_))
                source.path = *path;
            else if (!builtinFile(call.file))
                throw Error("asset.missing",
                            "there is no file \"" + call.file + "\"" + cure(call.file, {}));
        } else {
            countTriangles(words, assets_);  // throws over the limit
        }
        const std::string name = model.file.empty() ? "a model" : "\"" + model.file + "\"";
        report(Severity::info, "asset.generated", model.where,
               name + " is made by \"" + joined(source.words) + "\" (" + why + ")");
        return source;
    }

    const std::vector<std::string>* comment(const std::string& file) const {
        const auto& comments = scene_.generatorComments;
        const std::string base = baseNameOf(file);
        auto found = comments.find(file);
        if (found == comments.end()) found = comments.find(base);
        if (found == comments.end())  // as file names of some systems, whatever the case
            found = std::find_if(comments.begin(), comments.end(), [&](const auto& entry) {
                return scene::sameWord(entry.first, base);
            });
        return found == comments.end() ? nullptr : &found->second;
    }

    /// Names that `file` may have meant: its own with each shape's name in front.
    static std::vector<std::string> shapeNames(const std::string& file) {
        const std::string base = baseNameOf(file);
        const std::string rest = base.substr(std::min(base.find_first_of("_."), base.size()));
        std::vector<std::string> names;
        for (const Shape& one : shapes()) names.push_back(one.name + rest);
        return names;
    }

    /// What to do about a file that is not there: the nearest name, if any is near.
    std::string cure(const std::string& file, const std::vector<std::string>& candidates) const {
        std::string points = baseNameOf(file);
        std::replace(points.begin(), points.end(), ',', '.');
        if (points != baseNameOf(file) && wordsOfName(points))
            return "; write a point for the comma: \"" + points + "\"";
        const std::string near = nearestFile(file, assets_, candidates);
        return near.empty() ? "; add it to the scene's files, or mend the name" : near;
    }

    struct FoundFile {
        std::optional<std::string> path;
        std::string hint;
    };
    struct FoundModel {
        ModelSource source;
        Diagnostic fault{Severity::error, "", {}, "", ""};
    };

    scene::Scene& scene_;
    const scene::Assets& assets_;
    Diagnostics& diagnostics_;
    std::map<std::string, FoundFile> files_;
    std::map<std::tuple<std::string, std::string, int>, FoundModel> models_;
};

}  // namespace

void resolve(scene::Scene& scene, const scene::Assets& assets, Diagnostics& diagnostics) {
    Resolver(scene, assets, diagnostics).run();
    if (scene.entity) resolve(*scene.entity, assets, diagnostics);
}

}  // namespace farol::generator
