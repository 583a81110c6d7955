#include "generator/registry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "generator/entry.h"
#include "generator/io/mesh_file.h"
#include "generator/primitives/box.h"
#include "generator/primitives/cone.h"
#include "generator/primitives/cylinder.h"
#include "generator/primitives/ellipsoid.h"
#include "generator/primitives/frustum.h"
#include "generator/primitives/patch.h"
#include "generator/primitives/plane.h"
#include "generator/primitives/revolution.h"
#include "generator/primitives/ring.h"
#include "generator/primitives/sphere.h"
#include "generator/primitives/torus.h"
#include "generator/sources.h"
#include "scene/words.h"

namespace farol::generator {
namespace {

/// All shapes; entries and their shapes have the same index.
struct Table {
    std::vector<Entry> entries;
    std::vector<Shape> shapes;

    Table() {
        using namespace farol::generator::primitives;
        entries = {planeEntry(),     boxEntry(),     sphereEntry(),    coneEntry(),
                   cylinderEntry(),  torusEntry(),   patchEntry(),     ringEntry(),
                   ellipsoidEntry(), frustumEntry(), revolutionEntry()};
        for (const Entry& entry : entries) shapes.push_back(entry.shape);
    }
};

const Table& table() {
    static const Table made;
    return made;
}

/// A call with the bytes of its file, its triangles counted and within the limit.
struct Prepared {
    Call call;
    std::string bytes;
    std::size_t triangles = 0;
};

Prepared prepare(const std::vector<std::string>& words, const scene::Assets& assets) {
    Prepared out{parseCall(words), "", 0};
    if (out.call.shape->takesFile) out.bytes = readSource(out.call.file, assets);
    out.triangles = entryOf(*out.call.shape).count(out.call, out.bytes);
    if (out.triangles > kMaxTriangles)
        throw Error("limit.triangles", "this " + out.call.shape->name + " has " +
                                           std::to_string(out.triangles) + " triangles; at most " +
                                           std::to_string(kMaxTriangles) + " are allowed");
    return out;
}

/// The words of a shape, its file where it was found.
std::vector<std::string> wordsOf(const scene::ModelSource& source) {
    std::vector<std::string> words = source.words;
    if (!source.path.empty() && words.size() > 1) words[1] = source.path;
    return words;
}

/// Where the shape's argument `index` stands among its words.
std::size_t placeOf(const Shape& shape, std::size_t index) {
    return 1 + (shape.takesFile ? 1 : 0) + index;
}

bool isOpenAt(const Shape& shape, const scene::Model& model, std::size_t index) {
    const std::vector<std::string>& words = model.source.words;
    const std::size_t at = placeOf(shape, index);
    return shape.arguments[index].level &&
           (model.autoLod || at >= words.size() || words[at] == "auto");
}

std::vector<double> levelsOf(const Call& call) {
    std::vector<double> levels;
    for (std::size_t i = 0; i < call.shape->arguments.size(); ++i)
        if (call.shape->arguments[i].level) levels.push_back(call.values[i]);
    return levels;
}

}  // namespace

std::span<const Shape> shapes() { return table().shapes; }

const Shape* findShape(const std::string& name) {
    for (const Shape& shape : table().shapes) {
        if (scene::sameWord(shape.name, name)) return &shape;
        for (const std::string& alias : shape.aliases)
            if (scene::sameWord(alias, name)) return &shape;
    }
    return nullptr;
}

const Entry& entryOf(const Shape& shape) {
    return table().entries[static_cast<std::size_t>(&shape - table().shapes.data())];
}

Mesh generate(const std::vector<std::string>& words, const scene::Assets& assets,
              scene::UvLayout uv) {
    const Prepared ready = prepare(words, assets);
    return entryOf(*ready.call.shape).make(ready.call, ready.bytes, uv);
}

std::size_t countTriangles(const std::vector<std::string>& words, const scene::Assets& assets) {
    return prepare(words, assets).triangles;
}

bool isMeshName(const std::string& fileName) {
    constexpr std::string_view kEndings[] = {".3d", ".3db", ".obj", ".ply", ".tri", ".stl", ".off"};
    const std::size_t dot = std::min(fileName.rfind('.'), fileName.size());
    return std::any_of(std::begin(kEndings), std::end(kEndings), [&](std::string_view one) {
        return scene::sameWord(one, std::string_view(fileName).substr(dot));
    });
}

Mesh load(const scene::Model& model, const scene::Assets& assets, Diagnostics* findings) {
    using Kind = scene::ModelSource::Kind;
    const scene::ModelSource& source = model.source;
    if (source.kind == Kind::shape) return generate(wordsOf(source), assets, model.uv);
    const std::optional<std::string> bytes =
        source.kind == Kind::file ? assets.read(source.path) : std::nullopt;
    if (!bytes)
        throw Error("asset.missing", "the mesh \"" + model.file + "\" cannot be had", model.where);
    Diagnostics unheard;
    return io::decodeMesh(*bytes, source.path, findings != nullptr ? *findings : unheard);
}

bool isOpen(const scene::Model& model) {
    if (model.source.kind != scene::ModelSource::Kind::shape) return false;
    const Shape* shape = findShape(model.source.words.at(0));
    if (shape == nullptr || entryOf(*shape).levels == nullptr) return false;
    for (std::size_t i = 0; i < shape->arguments.size(); ++i)
        if (isOpenAt(*shape, model, i)) return true;
    return false;
}

std::optional<Surface> surfaceOf(const scene::Model& model) {
    if (model.source.kind != scene::ModelSource::Kind::shape) return std::nullopt;
    const Shape* shape = findShape(model.source.words.at(0));
    if (shape == nullptr || entryOf(*shape).surface == nullptr) return std::nullopt;
    for (std::size_t i = 0; i < shape->arguments.size(); ++i)
        if (shape->arguments[i].level && !isOpenAt(*shape, model, i)) return std::nullopt;
    return entryOf(*shape).surface(parseCall(model.source.words), model.uv);
}

double fullTurnOf(const std::vector<std::string>& words) {
    const Call call = parseCall(words);
    const Entry& entry = entryOf(*call.shape);
    if (entry.surface == nullptr) return 0.0;
    const std::vector<double> levels = levelsOf(call);
    switch (entry.surface(call, scene::UvLayout::face).kind) {
        case Surface::Kind::turned:
            return levels.at(0) - 1.0;  // the last copy is upon the first
        case Surface::Kind::ellipsoid:
            return std::min(levels.at(0), 2.0 * levels.at(1));
        case Surface::Kind::torus:
            return std::min(levels.at(0), levels.at(1));
        default:
            return levels.at(0);
    }
}

glm::dvec3 balanceOf(const std::vector<std::string>& words) {
    const Call call = parseCall(words);
    const Entry& entry = entryOf(*call.shape);
    if (entry.surface == nullptr) return glm::dvec3(1.0);
    const std::vector<double> levels = levelsOf(call);
    const Surface::Kind kind = entry.surface(call, scene::UvLayout::face).kind;
    const double slices = kind == Surface::Kind::turned ? levels.at(0) - 1.0 : levels.at(0);
    // The nearest point of a facet to the middle, on the unit circle or sphere.
    const double across = std::sin(std::numbers::pi / slices);
    if (kind == Surface::Kind::ellipsoid) {
        const double up = std::sin(std::numbers::pi / (2.0 * levels.at(1)));
        const double depth = std::sqrt(std::max(0.0, 1.0 - across * across - up * up));
        return glm::dvec3(2.0 / (1.0 + depth));
    }
    const double scale = 2.0 / (1.0 + std::sqrt(1.0 - across * across));
    return {scale, 1.0, scale};
}

std::vector<std::string> refine(const scene::Model& model, const scene::Assets& assets,
                                const Fineness& fineness) {
    std::vector<std::string> words = wordsOf(model.source);
    const Call call = parseCall(words);
    const Shape& shape = *call.shape;
    const std::string bytes = shape.takesFile ? readSource(call.file, assets) : std::string();
    const std::vector<double> levels = entryOf(shape).levels(call, bytes, fineness);
    std::size_t level = 0;
    for (std::size_t i = 0; i < shape.arguments.size(); ++i) {
        if (!shape.arguments[i].level) continue;
        const double chosen = std::max(shape.arguments[i].min, levels.at(level++));
        if (!isOpenAt(shape, model, i)) continue;
        words.resize(std::max(words.size(), placeOf(shape, i) + 1));
        words[placeOf(shape, i)] = std::to_string(static_cast<int>(chosen));
    }
    return words;
}

}  // namespace farol::generator
