#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/plan/bounds_tree.h"
#include "render/plan/mesh_library.h"
#include "render/plan/texture_ref.h"
#include "scene/expansion.h"
#include "scene/scene.h"

namespace farol::render {

/// A model at its place at one time.
struct Instance {
    const scene::Model* model;
    std::shared_ptr<const MeshData> mesh;
    glm::dmat4 worldFromObject;
    bool open;     ///< its divisions are the renderer's to choose
    int lightSet;  ///< index into InstanceList::lightSets
    int texture;   ///< index into InstanceList::textures, or -1
    int surface;   ///< index into InstanceList::surfaces, or -1
    int looks;     ///< index into InstanceList::looks of its mesh's first part, or -1
};

/// A material of a mesh's own part.
struct PartLook {
    const scene::PartMaterial* material;  ///< null: the file has none of that name
    int texture;                          ///< index into InstanceList::textures, or -1
};

/// A light at its place: position and direction in world space (camera lights: eye space).
struct PlacedLight {
    const scene::Light* light;
    glm::dvec3 position, direction;
};

/// A closed polyline in world space that a group moves along.
struct PlacedCurve {
    std::vector<glm::dvec3> points;
};

/// The content of a scene at one time, for any camera: made once for all its frames.
struct InstanceList {
    std::vector<Instance> instances;  ///< in document order
    BoundsTree tree;                  ///< of the instances, world space; those of no extent are out
    std::vector<TextureRef> textures;
    std::vector<generator::Surface> surfaces;  ///< exact ones, of models that are wholly open
    std::vector<PartLook> looks;               ///< of meshes with their own materials
    std::vector<PlacedLight> lights;
    std::vector<std::vector<int>> lightSets;  ///< indices into lights; set 0: the scene's own
    std::vector<PlacedCurve> curves;
    Diagnostics findings;  ///< of the mesh files, each once, and of the lights
    Box bounds;            ///< world space
    bool anyOpen = false;  ///< of the instances
    bool dressed = false;  ///< a mesh has colours or materials that are drawn
};

/// Limits of one frame.
using scene::kMaxInstances;
inline constexpr std::size_t kMaxLights = 512;

/// Walks the groups at a time. Throws Error limit.* and as MeshLibrary::get does. The scene must
/// outlive the list.
InstanceList collect(const scene::Scene& scene, double timeS, bool curves,
                     const scene::Assets& assets, MeshLibrary& meshes);

/// A scene and the entity before its third-person camera.
struct Placed {
    InstanceList scene;
    std::optional<InstanceList> entity;
};

/// Both walked at a time, as collect does. `curves`: of the scene, not of the entity.
Placed place(const scene::Scene& scene, double timeS, bool curves, const scene::Assets& assets,
             MeshLibrary& meshes);

/// About how much memory a placed scene keeps, bytes, with its meshes.
std::size_t bytesOf(const Placed& placed);

}  // namespace farol::render
