#include "scene/files/resolve.h"

#include <algorithm>
#include <map>
#include <optional>

#include "core/number.h"
#include "core/text.h"
#include "generator/call.h"
#include "generator/io/mesh_file.h"
#include "generator/io/mtl.h"
#include "generator/messages.h"
#include "generator/registry.h"
#include "generator/sources.h"
#include "generator/words.h"

namespace farol::generator {
namespace {

using scene::ModelSource;
constexpr int kProfileCopies = 65;  ///< of a profile without `revolve`
using Words = std::vector<std::string>;

/// Finds the file or the shape that a model means.
class ModelFinder {
  public:
    ModelFinder(const std::map<std::string, Words>& comments, const scene::Assets& assets,
                scene::Locator& locator, Diagnostics& diagnostics)
        : comments_(comments), assets_(assets), locator_(locator), diagnostics_(diagnostics) {}

    /// Throws Error where the model is neither a file nor a shape.
    ModelSource find(const scene::Model& model) {
        if (model.revolve)
            return shape(parseCall({"revolution", model.file, std::to_string(*model.revolve)}),
                         model, message<"part.by-profile">());
        const auto path = model.file.empty()
                              ? std::nullopt
                              : locator_.locate(model.file, model.where, diagnostics_);
        if (path) {
            report(Severity::info,
                   message<"asset.from-file">("file"_arg = uncut(model.file),
                                              "path"_arg = uncut(*path)),
                   model.where);
            if (isProfile(*path)) {
                report(Severity::warning,
                       message<"mesh.assumed/profile">("file"_arg = model.file,
                                                       "copies"_arg = kProfileCopies),
                       model.where);
                return shape(parseCall({"revolution", model.file, std::to_string(kProfileCopies)}),
                             model, message<"part.by-profile">());
            }
            if (const ShapeEntry* entry = shapeOfFile(*path))
                return {ModelSource::Kind::shape, *path, parseCall({entry->name, *path})};
            ModelSource source{ModelSource::Kind::file, *path};
            source.materials = materialsOf(*path, model.where);
            source.fallback = fallbackOf(model);
            return source;
        }
        if (!model.command.empty())
            return shape(parseComment(splitWords(model.command), "", model.where, diagnostics_),
                         model, message<"part.by-command">());
        const auto named = wordsOfName(model.file);
        if (const Words* words = comment(model.file))
            if (const auto source = fromComment(*words, named, model)) return *source;
        if (named) return fromName(*named, model);
        if (builtinFile(model.file)) {
            const std::string file(baseName(model.file));
            return shape(parseCall({shapeOfFile(file)->name, file}), model,
                         message<"part.by-builtin">());
        }
        throw Error(message<"asset.missing/model">(
            "file"_arg = model.file,
            "fix"_arg = advice(model.file, model.where, shapeNames(model.file))));
    }

  private:
    void report(Severity severity, Message message, const Location& where) {
        diagnostics_.push_back(diagnosticOf(severity, std::move(message), where));
    }

    bool isProfile(const std::string& path) const {
        if (fileEnding(path) != "ply") return false;
        const std::optional<std::string> bytes = assets_.read(path);
        return bytes && io::isPlyProfile(*bytes, path);
    }

    /// Returns the materials of an OBJ file; null where it names none. An unreadable library is a
    /// warning; its parts keep the scene's colours.
    std::shared_ptr<const std::vector<scene::PartMaterial>> materialsOf(const std::string& path,
                                                                        const Location& where) {
        if (fileEnding(path) != "obj") return nullptr;
        const std::optional<std::string> bytes = assets_.read(path);
        if (!bytes) return nullptr;
        std::vector<scene::PartMaterial> all;
        for (const std::string& name : io::materialLibraries(*bytes)) {
            const std::optional<std::string> file = beside(path, name, where);
            const std::optional<std::string> text = file ? assets_.read(*file) : std::nullopt;
            if (!text) {
                report(Severity::warning,
                       message<"mesh.material/file">("file"_arg = uncut(name),
                                                     "mesh"_arg = uncut(path)),
                       where);
                continue;
            }
            for (scene::PartMaterial& one : io::parseMtl(*text, *file, diagnostics_)) {
                if (one.texture) findTexture(one, *file, where);
                all.push_back(std::move(one));
            }
        }
        if (all.empty()) return nullptr;
        return std::make_shared<const std::vector<scene::PartMaterial>>(std::move(all));
    }

    void findTexture(scene::PartMaterial& part, const std::string& library, const Location& where) {
        const std::optional<std::string> file = beside(library, part.texture->file, where);
        if (file) {
            part.texture->path = *file;
            return;
        }
        report(Severity::warning,
               message<"mesh.material/texture">("file"_arg = uncut(part.texture->file),
                                                "material"_arg = part.name),
               part.texture->where);
        part.texture.reset();
    }

    /// Finds a file that the file `file` names. Findings are at `where`, in the scene.
    std::optional<std::string> beside(const std::string& file, const std::string& name,
                                      const Location& where) {
        Diagnostics found;
        std::optional<std::string> path = locator_.locate(name, {file, 0, 0}, found);
        for (Diagnostic& one : found) {
            one.where = where;
            diagnostics_.push_back(std::move(one));
        }
        return path;
    }

    /// Returns the shape of a home-made mesh file's name or comment, used if its format is unknown.
    std::optional<ShapeCall> fallbackOf(const scene::Model& model) {
        if (fileEnding(model.file) != "3d") return std::nullopt;
        Diagnostics unheard;  // dropped: the fallback is seldom used
        const Words* words = comment(model.file);
        const auto named = wordsOfName(model.file);
        for (const bool byComment : {true, false}) {
            try {
                if (byComment && words == nullptr) continue;
                if (!byComment && (!named || named->size() < 2)) continue;
                const ShapeCall call = byComment
                                           ? parseComment(*words, model.file, model.where, unheard)
                                           : parseCall(*named);
                if (call.entry->takesFile) continue;
                countTriangles(call, assets_);  // throws over the limit
                return call;
            } catch (const Error&) {  // not a valid shape
            }
        }
        return std::nullopt;
    }

    /// Resolves by a comment; ignores an invalid one if the name alone describes the shape.
    std::optional<ModelSource> fromComment(const Words& words, const std::optional<Words>& named,
                                           const scene::Model& model) {
        try {
            return shape(parseComment(words, model.file, model.where, diagnostics_), model,
                         message<"part.by-comment">());
        } catch (const Error& error) {
            if (!named || named->size() < 2) throw;
            report(Severity::warning, unusedComment(error), model.where);
            return std::nullopt;
        }
    }

    /// The warning about a generator comment that cannot be read, with the error's code.
    static Message unusedComment(const Error& error) {
        const auto problem = "problem"_arg = error.primary();
        if (error.code() == "shape.unknown") return message<"shape.unknown/comment">(problem);
        if (error.code() == "asset.missing") return message<"asset.missing/comment">(problem);
        if (error.code() == "limit.triangles") return message<"limit.triangles/comment">(problem);
        return message<"shape.argument/comment">(problem);
    }

    /// "sphere.3d" alone gives no size: uses the usual one, with a warning.
    ModelSource fromName(Words words, const scene::Model& model) {
        const ShapeEntry* named = findShape(words[0]);
        if (words.size() == 1 && named != nullptr) {
            if (locator_.leadsOut(model.file, model.where))
                report(
                    Severity::warning,
                    message<"asset.outside">("file"_arg = model.file,
                                             "fix"_arg = locator_.advice(model.file, model.where)),
                    model.where);
            for (std::size_t i = 0; i < named->required; ++i)
                words.push_back(formatNumber(named->arguments[i].usual));
            report(Severity::warning,
                   message<"shape.guessed">("file"_arg = uncut(model.file),
                                            "call"_arg = textOf(parseCall(words))),
                   model.where);
        }
        std::vector<Message> notes;
        const ShapeCall call = parseCall(words, &notes);
        for (Message& note : notes) report(Severity::warning, std::move(note), model.where);
        return shape(call, model, message<"part.by-name">());
    }

    ModelSource shape(const ShapeCall& call, const scene::Model& model, const Message& reason) {
        ModelSource source{ModelSource::Kind::shape, "", call, call.entry->isSheet};
        if (call.entry->takesFile) {
            if (const auto path = locator_.locate(call.file, model.where, diagnostics_))
                source.path = *path;
            else if (!builtinFile(call.file))
                throw Error(message<"asset.missing/file">(
                    "file"_arg = call.file, "fix"_arg = advice(call.file, model.where, {})));
        } else {
            countTriangles(call, assets_);  // throws over the limit
        }
        const auto made = "call"_arg = textOf(call);
        report(Severity::info,
               model.file.empty() ? message<"asset.generated/model">(made, "reason"_arg = reason)
                                  : message<"asset.generated/file">("file"_arg = uncut(model.file),
                                                                    made, "reason"_arg = reason),
               model.where);
        return source;
    }

    const Words* comment(const std::string& file) {
        const std::string base(baseName(file));
        auto found = comments_.find(file);
        if (found == comments_.end()) found = comments_.find(base);
        if (found != comments_.end()) return &found->second;
        if (!alike_) {  // case-insensitive, as file names of some systems
            alike_.emplace();
            for (const auto& [name, words] : comments_) alike_->emplace(lowerCase(name), &words);
        }
        const auto alike = alike_->find(lowerCase(base));
        return alike == alike_->end() ? nullptr : alike->second;
    }

    /// Names that `file` may have meant: its own with each shape's name in front.
    static Words shapeNames(const std::string& file) {
        const std::string base(baseName(file));
        const std::string rest = base.substr(std::min(base.find_first_of("_."), base.size()));
        Words names;
        for (const ShapeEntry& shape : shapes()) names.push_back(shape.name + rest);
        return names;
    }

    /// Returns how to fix a missing file: the nearest name, if one is near.
    Message advice(const std::string& file, const Location& where, Words candidates) {
        const std::string base(baseName(file));
        std::string points = base;
        std::replace(points.begin(), points.end(), ',', '.');
        if (points != base && wordsOfName(points))
            return message<"part.point-for-comma">("name"_arg = points);
        for (std::string& name : builtinNames()) candidates.push_back(std::move(name));
        return locator_.advice(file, where, std::move(candidates));
    }

    const std::map<std::string, Words>& comments_;
    const scene::Assets& assets_;
    scene::Locator& locator_;
    Diagnostics& diagnostics_;
    /// Generator comments by their names in lower case, made on first use.
    std::optional<std::map<std::string, const Words*>> alike_;
};

}  // namespace

void resolve(scene::Scene& scene, const scene::Assets& assets, Diagnostics& diagnostics) {
    scene::Locator locator(assets, scene.document);
    ModelFinder finder(scene.generatorComments, assets, locator, diagnostics);
    scene::resolveFiles(
        scene, locator, [&](const scene::Model& model) { return finder.find(model); }, diagnostics);
    if (scene.entity) resolve(*scene.entity, assets, diagnostics);
}

}  // namespace farol::generator
