#pragma once

#include <memory>

#include "render/plan/shadow_maps.h"

namespace farol::render {

/// Returns the part of a mesh that is in a parallel light's map, in light space, where the mesh
/// reaches so far beyond the map that floats would move its planes by texels: a wide ground. Null:
/// there is no need, or the mesh has too many triangles. `lightFromObject`: in double.
std::shared_ptr<const MeshData> cutToMap(const MeshData& data, const glm::dmat4& lightFromObject,
                                         const LightView& light);

}  // namespace farol::render
