#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "render/plan/camera.h"
#include "render/plan/instances.h"

namespace farol::render {

/// The corners of an instance's box, world space.
struct CastingBox {
    std::array<glm::dvec3, 8> corners{};
    bool isThere = false;  ///< it has triangles
    bool casts = false;    ///< and is not seen through
};

/// Of each instance. `isTransparent`: models with an opacity under 1 are seen through.
std::vector<CastingBox> castingBoxes(const InstanceList& list, bool isTransparent);

/// A light in world space: its place, or the unit vector towards it.
struct LightPlace {
    glm::dvec3 at{0.0};
    bool isPositional = false;
};

/// Indices of the instances whose shadow may fall on another or on themselves. Large convex models
/// that have all others before one of their faces, as a ground has, cast none from a light before
/// that face: maps are then fitted to what stands on it.
std::vector<std::size_t> castersUnder(const InstanceList& list,
                                      const std::vector<CastingBox>& boxes,
                                      const LightPlace& light);

/// Returns the length of the boxes' diagonals, world units. Where it is less than the scene's own,
/// models are far apart.
double sumOfDiagonals(const std::vector<CastingBox>& boxes);

/// Corners of the part of a box (world space) that is in the view; empty where nothing is.
std::vector<glm::dvec3> visibleCorners(const std::array<glm::dvec3, 8>& box,
                                       const ViewTransform& view);
/// The same of the boxes together, each by itself.
std::vector<glm::dvec3> visibleCorners(const std::vector<CastingBox>& boxes,
                                       const ViewTransform& view);

}  // namespace farol::render
