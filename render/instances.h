#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "render/mesh_library.h"
#include "scene/scene.h"

namespace farol::render {

/// A model at its place at one time.
struct Instance {
    const scene::Model* model;
    std::shared_ptr<const MeshData> mesh;
    glm::dmat4 worldFromObject;
    bool open;     ///< its divisions are the renderer's to choose
    int lightSet;  ///< index into InstanceList::lightSets
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

struct InstanceList {
    std::vector<Instance> instances;
    std::vector<PlacedLight> lights;
    std::vector<std::vector<int>> lightSets;  ///< indices into lights; set 0: the scene's own
    std::vector<PlacedCurve> curves;
    Diagnostics findings;  ///< of the mesh files, each once
    Box bounds;            ///< world space
};

/// Bounds on what one frame may hold.
inline constexpr std::size_t kMaxInstances = 200'000;
inline constexpr std::size_t kMaxLights = 512;

/// Walks the groups at a time. Throws Error limit.* and as MeshLibrary::get does.
InstanceList collect(const scene::Scene& scene, double timeS, bool curves,
                     const scene::Assets& assets, MeshLibrary& meshes);

}  // namespace farol::render
