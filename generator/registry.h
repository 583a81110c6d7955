#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "generator/fineness.h"
#include "generator/mesh.h"
#include "generator/surface.h"
#include "scene/assets.h"
#include "scene/scene.h"

/// The one door to the generator: shapes by name, meshes by source.
namespace farol::generator {

/// One argument of a shape, for messages, help and the API.
struct Argument {
    std::string name;  ///< "slices"
    bool integer;      ///< a count, else a length in the scene's units
    double min, max;   ///< inclusive range
    std::string help;
    double fallback = 0;  ///< the value where the argument is left out
    bool level = false;   ///< fineness alone: left out or "auto", it may be chosen on demand
    /// The argument that this word is instead where it is the last one: of "box 2 3" the 3 is DIV.
    std::optional<std::size_t> whenLast = {};
};

/// One registered shape. `required` arguments come first; the rest have defaults on demand.
struct Shape {
    std::string name;
    std::string summary;  ///< its geometry in one sentence
    std::vector<Argument> arguments;
    std::size_t required;
    bool takesFile;  ///< the first word after the name is a profile or patch file
    std::vector<std::string> aliases = {};
    std::string form = "";  ///< how its arguments are written, where brackets cannot say it
};

/// How a shape is written: "cone RADIUS HEIGHT [SLICES] [STACKS]".
std::string usageOf(const Shape& shape);

/// All shapes, in the order of the help.
std::span<const Shape> shapes();

/// The shape of that name or alias ("bezier" is patch), case-insensitive, or null.
const Shape* findShape(const std::string& name);

/// Makes the mesh of `words` ({"cone","1","2","4","3"}); files are read from `assets`, then from
/// the built-ins (teapot.patch). Throws Error shape.unknown (with a did-you-mean),
/// shape.argument (names the argument and its range), limit.triangles, asset.missing, mesh.*.
Mesh generate(const std::vector<std::string>& words, const scene::Assets& assets,
              scene::UvLayout uv = scene::UvLayout::face);

/// The number of triangles `generate` would make, without making them (patch files are read); an
/// upper bound where a patch or profile folds points together. Throws as generate does.
std::size_t countTriangles(const std::vector<std::string>& words, const scene::Assets& assets);

/// Fills in Model::source of every model of the scene (entity included), and Texture::path,
/// Background::path and Skybox::path: 1. a file of that name in the bundle; 2. a generator
/// comment; 3. the name itself ("cone_1_2_4_3.3d"); built-ins last. Says where each model came
/// from (severity info) and checks shape arguments. Adds errors for what cannot be found; does
/// not throw.
void resolve(scene::Scene& scene, const scene::Assets& assets, Diagnostics& diagnostics);

/// True for a name with the ending of a mesh file, but for .patch, which takes a level.
bool isMeshName(const std::string& fileName);

/// The mesh of a resolved model. Throws as generate and io::decodeMesh do; what was repaired in
/// a mesh file is added to `findings` where it is given.
Mesh load(const scene::Model& model, const scene::Assets& assets, Diagnostics* findings = nullptr);

/// True when a model's shape leaves divisions open (left out, "auto", or all of them by
/// lod="auto"): its mesh is made as fine as the picture needs. What is written is honoured to the
/// letter.
bool isOpen(const scene::Model& model);

/// The exact surface of a model whose divisions are all open; nothing where some are written (the
/// mesh is then what is meant) or the shape is none of Surface's.
std::optional<Surface> surfaceOf(const scene::Model& model);

/// Divisions of a full turn of a shape that Surface knows, in its coarser direction; 0 for other
/// words.
double fullTurnOf(const std::vector<std::string>& words);

/// The scale, object space, by which the mesh of a shape that Surface knows errs as far outwards as
/// inwards (a torus: round its ring); 1 for other words.
glm::dvec3 balanceOf(const std::vector<std::string>& words);

/// The words of an open model with its divisions chosen: the coarsest of a small ladder that keep
/// `fineness`. Throws as load does.
std::vector<std::string> refine(const scene::Model& model, const scene::Assets& assets,
                                const Fineness& fineness);

/// Upper bound on triangles of one mesh, counted before memory is taken for it.
inline constexpr std::size_t kMaxTriangles = 5'000'000;

}  // namespace farol::generator
