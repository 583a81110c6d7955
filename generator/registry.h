#pragma once

#include <optional>
#include <span>
#include <string>

#include "generator/call.h"
#include "generator/entry.h"
#include "generator/fineness.h"
#include "generator/mesh.h"
#include "generator/surface.h"
#include "scene/files/assets.h"
#include "scene/scene.h"

/// The interface of the generator: shapes by name, meshes by source.
namespace farol::generator {

/// Returns the syntax of a shape: "cone RADIUS HEIGHT [SLICES] [STACKS]".
std::string usageOf(const ShapeEntry& shape);

/// All shapes, in the order of the help.
std::span<const ShapeEntry> shapes();

/// The shape of that name or alias ("bezier" is patch), case-insensitive, or null.
const ShapeEntry* findShape(const std::string& name);

/// Makes the mesh of a call; files are read from `assets`, then from the built-ins (teapot.patch).
/// Throws Error limit.triangles, asset.missing, mesh.*.
Mesh generate(const ShapeCall& call, const scene::Assets& assets,
              scene::UvLayout uv = scene::UvLayout::face);

/// The number of triangles `generate` would make, without making them (patch files are read); an
/// upper bound where a patch or profile folds points together. Throws as generate does.
std::size_t countTriangles(const ShapeCall& call, const scene::Assets& assets);

/// Fills in Model::source of every model of the scene (entity included), and Texture::path,
/// Background::path and Skybox::path: 1. a file of that name in the bundle; 2. a generator
/// comment; 3. the name itself ("cone_1_2_4_3.3d"); built-ins last. Reports the source of each
/// model (severity info) and checks shape arguments. Adds an error for each missing file; does
/// not throw.
void resolve(scene::Scene& scene, const scene::Assets& assets, Diagnostics& diagnostics);

/// True for a name with the ending of a mesh file, but for .patch, which takes a level.
bool isMeshName(const std::string& fileName);

/// Returns the mesh of a resolved model. Throws as generate and io::decodeMesh do. Adds the repairs
/// of a mesh file to `findings` unless it is null.
Mesh load(const scene::Model& model, const scene::Assets& assets, Diagnostics* findings = nullptr);

/// True when a model's shape leaves divisions open (left out, "auto", or all of them by
/// lod="auto"): each image chooses them by the size of the model on screen. Written divisions are
/// never changed.
bool isAdaptive(const scene::Model& model);

/// Returns the exact surface of a model whose divisions are all open. Nothing where some are
/// written (the mesh itself is then intended) or no SurfaceKind describes the shape.
std::optional<Surface> surfaceOf(const scene::Model& model);

/// Returns the divisions of a full turn of a shape with a SurfaceKind, in its coarser direction; 0
/// for other shapes.
double fullTurnOf(const ShapeCall& call);

/// Returns the scale, object space, that makes the mesh of a shape with a SurfaceKind err equally
/// outwards and inwards (a torus: around its ring); 1 for other shapes.
glm::dvec3 balancedScale(const ShapeCall& call);

/// Returns the call of an adaptive model with the coarsest divisions that keep `fineness`, rounded
/// up by roundUpToStep; its file is the resolved path. Throws as load does.
ShapeCall refine(const scene::Model& model, const scene::Assets& assets, const Fineness& fineness);

/// A mesh made by `adapt`; equal divisions of one file are equal meshes.
struct AdaptedMesh {
    std::vector<std::size_t> divisions;
    Mesh mesh;
};

/// Returns the mesh of an adaptive model that keeps `fineness` by divisions of each edge (patches);
/// nothing for shapes with one set of divisions (refine). Throws as load does.
std::optional<AdaptedMesh> adapt(const scene::Model& model, const scene::Assets& assets,
                                 const Fineness& fineness);

}  // namespace farol::generator
