#include "generator/registry.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "generator/io/mesh_file.h"
#include "generator/messages.h"
#include "generator/primitives/box.h"
#include "generator/primitives/cone.h"
#include "generator/primitives/cylinder.h"
#include "generator/primitives/dome.h"
#include "generator/primitives/ellipsoid.h"
#include "generator/primitives/frustum.h"
#include "generator/primitives/patch.h"
#include "generator/primitives/plane.h"
#include "generator/primitives/revolution.h"
#include "generator/primitives/ring.h"
#include "generator/primitives/sphere.h"
#include "generator/primitives/torus.h"
#include "generator/primitives/wedge.h"
#include "generator/sources.h"

namespace farol::generator {
namespace {

const std::vector<ShapeEntry>& table() {
    using namespace farol::generator::primitives;
    static const std::vector<ShapeEntry> made = {
        planeEntry(),      boxEntry(),   sphereEntry(), coneEntry(),      cylinderEntry(),
        torusEntry(),      patchEntry(), ringEntry(),   ellipsoidEntry(), frustumEntry(),
        revolutionEntry(), wedgeEntry(), domeEntry()};
    return made;
}

/// The bytes of a call's file, and its triangles, which are within the limit.
struct Prepared {
    std::string bytes;
    std::size_t triangles = 0;
};

std::string fileBytes(const ShapeCall& call, const scene::Assets& assets) {
    return call.entry->takesFile ? readSource(call.file, assets) : "";
}

Prepared prepare(const ShapeCall& call, const scene::Assets& assets) {
    Prepared out{fileBytes(call, assets), 0};
    out.triangles = call.entry->count(call, out.bytes);
    if (out.triangles > kMaxTriangles)
        throw Error(message<"limit.triangles/shape">("shape"_arg = call.entry->name,
                                                     "count"_arg = out.triangles,
                                                     "most"_arg = kMaxTriangles));
    return out;
}

/// The call of a shape, its file where it was found.
ShapeCall callOf(const scene::ModelSource& source) {
    ShapeCall call = source.shape;
    if (!source.path.empty()) call.file = source.path;
    return call;
}

bool isOpenAt(const scene::Model& model, std::size_t index) {
    const ShapeCall& call = model.source.shape;
    return call.entry->arguments[index].isLevel() && (model.autoLod || !call.isWritten(index));
}

std::vector<double> levelsOf(const ShapeCall& call) {
    std::vector<double> levels;
    for (std::size_t i = 0; i < call.arguments.size(); ++i)
        if (call.entry->arguments[i].isLevel()) levels.push_back(call.arguments[i].value);
    return levels;
}

const SurfaceKind* kindOf(const ShapeCall& call) {
    if (call.entry->surface == nullptr) return nullptr;
    return call.entry->surface(call, scene::UvLayout::face).kind;
}

}  // namespace

std::span<const ShapeEntry> shapes() { return table(); }

const ShapeEntry* findShape(const std::string& name) {
    for (const ShapeEntry& shape : table()) {
        if (sameWord(shape.name, name)) return &shape;
        for (const std::string& alias : shape.aliases)
            if (sameWord(alias, name)) return &shape;
    }
    return nullptr;
}

Mesh generate(const ShapeCall& call, const scene::Assets& assets, scene::UvLayout uv) {
    return call.entry->generate(call, prepare(call, assets).bytes, uv);
}

std::size_t countTriangles(const ShapeCall& call, const scene::Assets& assets) {
    return prepare(call, assets).triangles;
}

bool isMeshName(const std::string& fileName) {
    constexpr std::string_view kEndings[] = {"3d", "3db", "obj", "ply", "tri", "stl", "off"};
    return std::find(std::begin(kEndings), std::end(kEndings), fileEnding(fileName)) !=
           std::end(kEndings);
}

Mesh load(const scene::Model& model, const scene::Assets& assets, Diagnostics* findings) {
    using Kind = scene::ModelSource::Kind;
    const scene::ModelSource& source = model.source;
    if (source.kind == Kind::shape) return generate(callOf(source), assets, model.uv);
    const std::optional<std::string> bytes =
        source.kind == Kind::file ? assets.read(source.path) : std::nullopt;
    if (!bytes)
        throw Error(message<"asset.missing/mesh">("file"_arg = uncut(model.file)), model.where);
    Diagnostics unheard;
    Diagnostics& heard = findings != nullptr ? *findings : unheard;
    try {
        return io::decodeMesh(*bytes, source.path, heard);
    } catch (const Error& error) {
        // Files over a limit are refused, not replaced by the fallback.
        if (!source.fallback || error.code().rfind("mesh.", 0) != 0) throw;
        heard.push_back(diagnosticOf(
            Severity::warning,
            message<"mesh.replaced">("file"_arg = source.path, "problem"_arg = error.primary(),
                                     "shape"_arg = textOf(*source.fallback)),
            error.primary().where));
        return generate(*source.fallback, assets, model.uv);
    }
}

bool isAdaptive(const scene::Model& model) {
    if (model.source.kind != scene::ModelSource::Kind::shape) return false;
    const ShapeEntry& entry = *model.source.shape.entry;
    if (entry.bound == nullptr) return false;
    for (std::size_t i = 0; i < entry.arguments.size(); ++i)
        if (isOpenAt(model, i)) return true;
    return false;
}

std::optional<Surface> surfaceOf(const scene::Model& model) {
    if (model.source.kind != scene::ModelSource::Kind::shape) return std::nullopt;
    const ShapeEntry& entry = *model.source.shape.entry;
    if (entry.surface == nullptr) return std::nullopt;
    for (std::size_t i = 0; i < entry.arguments.size(); ++i)
        if (entry.arguments[i].isLevel() && !isOpenAt(model, i)) return std::nullopt;
    return entry.surface(model.source.shape, model.uv);
}

double fullTurnOf(const ShapeCall& call) {
    const SurfaceKind* kind = kindOf(call);
    return kind != nullptr ? kind->fullTurn(levelsOf(call)) : 0.0;
}

glm::dvec3 balancedScale(const ShapeCall& call) {
    const SurfaceKind* kind = kindOf(call);
    return kind != nullptr ? kind->balance(levelsOf(call)) : glm::dvec3(1.0);
}

ShapeCall refine(const scene::Model& model, const scene::Assets& assets, const Fineness& fineness) {
    ShapeCall call = callOf(model.source);
    const std::vector<double> levels = call.entry->bound(call, fileBytes(call, assets), fineness);
    std::size_t level = 0;
    for (std::size_t i = 0; i < call.arguments.size(); ++i) {
        const Argument& argument = call.entry->arguments[i];
        if (!argument.isLevel()) continue;
        const double chosen = std::floor(std::max(argument.min, levels.at(level++)));
        if (isOpenAt(model, i)) call.arguments[i] = {scene::ShapeArgument::Form::written, chosen};
    }
    return call;
}

std::optional<AdaptedMesh> adapt(const scene::Model& model, const scene::Assets& assets,
                                 const Fineness& fineness) {
    const ShapeCall call = callOf(model.source);
    if (call.entry->adapt == nullptr) return std::nullopt;
    std::vector<std::size_t> divisions;
    Mesh mesh = call.entry->adapt(call, fileBytes(call, assets), fineness, divisions);
    return AdaptedMesh{std::move(divisions), std::move(mesh)};
}

}  // namespace farol::generator
