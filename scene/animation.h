#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace farol::scene {

struct CurvePoint {
    glm::dvec3 position;
    glm::dvec3 tangent;  ///< derivative by the curve's parameter, not normalised; may be zero
};

/// The closed uniform Catmull-Rom curve (tension 1/2) through `points` (at least 1; fewer than 4
/// still make a closed curve) at lap fraction `u` (any finite number; the curve repeats every 1).
CurvePoint catmullRom(const std::vector<glm::dvec3>& points, double u);

/// parentFromLocal of one transform at `timeS` seconds; depends on the time alone (no drift).
/// Aligned curves: x = tangent, z = x cross up, y = z cross x; up transported from +Y at t = 0
/// in fixed steps.
glm::dmat4 matrixAt(const Transform& transform, double timeS);

/// The product of a group's transforms in document order, each multiplied on the right.
glm::dmat4 matrixAt(const std::vector<Transform>& transforms, double timeS);

/// The colour at a time: `rgb` itself, or a saturated hue that turns (HSV to RGB, period
/// kHueSeconds).
glm::vec3 colorAt(const Color& color, double timeS);
inline constexpr double kHueSeconds = 6.0;

/// Places of a scattered group's copies: parentFromCopy, the same for the same `seed`.
std::vector<glm::dmat4> scatterMatrices(const Scatter& scatter, std::uint64_t seed);

/// True if any transform or colour of the scene depends on the time.
bool isAnimated(const Scene& scene);

}  // namespace farol::scene
