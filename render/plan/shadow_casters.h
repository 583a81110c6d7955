#pragma once

#include <functional>

#include "render/plan/frame_plan.h"
#include "render/plan/instances.h"
#include "render/plan/mesh_library.h"
#include "render/plan/shadow_maps.h"

namespace farol::render {

/// Supplies what the models of shadow maps are made of. Must outlive the calls that it is given to.
struct CasterSource {
    const InstanceList& list;
    const scene::Assets& assets;
    MeshLibrary& meshes;
    /// Returns the index into FramePlan::textures of one of InstanceList::textures.
    std::function<int(std::size_t)> textureIndex;
    double coarsening = 1.0;    ///< of the errors of open shapes (crowd.h)
    bool isTransparent = true;  ///< textures may have holes, and models be seen through
};

/// DrawItem::shadowOffset. The mesh of an open model in a map differs from the drawn surface, by
/// less than a texel's half and, where pixels do not follow their rays to the exact surface, by the
/// error of the drawn mesh, `error` as a share of the distance. Faces with smooth normals: half
/// their size.
glm::vec3 shadowOffsetOf(const DrawItem& item, const Instance& instance, double error);

/// Adds the maps to the plan, with all models that may cast a shadow into them; composePasses
/// chooses those that do. Counts maps and triangles.
void addShadowMaps(FramePlan& plan, const PlannedShadows& shadows, const CasterSource& source);

}  // namespace farol::render
