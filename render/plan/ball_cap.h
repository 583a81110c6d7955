#pragma once

#include <optional>

#include "generator/registry.h"
#include "render/plan/near_mesh.h"

namespace farol::render {

/// The part of a ball that is seen from a place just above it (or just below: all of its inside),
/// in rings round the point beneath the viewer, each as wide as `errorPx` allows at its distance:
/// divisions of the whole ball would be too many.
struct BallCap {
    ExactMesh mesh;
    glm::dvec3 eye{0.0};   ///< in the surface's units
    double errorPx = 0.0;  ///< more than asked for where the rings are capped
};

/// Returns nothing for surfaces that are no balls, for flattened ones, and if the viewer is so
/// close that doubles cannot resolve its height. `worldFromObject` places the ball's units times
/// Surface::lengths; colours and texture coordinates are left to the surface.
std::optional<BallCap> ballCap(const generator::Surface& surface, const glm::dmat4& worldFromObject,
                               const ViewTransform& view, double errorPx);

}  // namespace farol::render
