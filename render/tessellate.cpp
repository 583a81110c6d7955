#include "render/tessellate.h"

#include <algorithm>
#include <cmath>

namespace farol::render {
namespace {

/// Distance from the viewer to the box, object axes, in view units; 0 inside.
double distanceTo(const Box& bounds, const glm::dmat4& viewFromObject, double smallest) {
    const glm::dvec3 eye(glm::inverse(viewFromObject) * glm::dvec4(0, 0, 0, 1));
    const glm::dvec3 outside = glm::max(glm::max(bounds.min - eye, eye - bounds.max), 0.0);
    const double distance = glm::length(outside);
    if (distance > 0.0) return smallest * distance;
    // Within the box, often within the shape: the far walls are what is seen, but the surface may
    // be anywhere, so the near plane decides.
    return 0.0;
}

/// Divisions of a full turn below which interpolated normals and texture coordinates are off by
/// more than about half a level of 255 (measured on a unit sphere with shininess 50: rms 0.87 at 32
/// and 0.24 at 64 slices lit per pixel, 0.94 at 64 and 0.25 at 128 lit per vertex).
double shadingDivisions(scene::Shading shading, double radiusPx) {
    double divisions = 8.0;
    if (shading == scene::Shading::phong || shading == scene::Shading::solid) divisions = 48.0;
    if (shading == scene::Shading::gouraud) divisions = 96.0;
    // Nobody sees the highlight of something a few pixels large.
    if (radiusPx < 4.0) divisions = std::min(divisions, 16.0);
    if (radiusPx < 1.0) divisions = 8.0;
    return divisions;
}

}  // namespace

generator::Fineness fineness(const Box& bounds, const glm::dmat4& viewFromObject, bool textured,
                             const Sight& sight) {
    const glm::dmat3 linear(viewFromObject);
    // Singular values: square roots of the eigenvalues of the Gram matrix. The Frobenius norm
    // bounds the largest within sqrt(3), the determinant over its square the smallest: loose
    // bounds would cost triangles, so the columns of an orthogonal scale are taken as they are.
    const glm::dvec3 columns(glm::length(linear[0]), glm::length(linear[1]),
                             glm::length(linear[2]));
    const double dots = std::abs(glm::dot(linear[0], linear[1])) +
                        std::abs(glm::dot(linear[1], linear[2])) +
                        std::abs(glm::dot(linear[2], linear[0]));
    const double frobenius = glm::length(columns);
    const bool orthogonal = dots <= 1e-9 * frobenius * frobenius;
    const double largest = orthogonal ? std::max({columns.x, columns.y, columns.z}) : frobenius;
    const double smallest =
        orthogonal ? std::min({columns.x, columns.y, columns.z})
                   : std::abs(glm::determinant(linear)) / std::max(1e-300, largest * largest);

    const double halfFov = glm::radians(sight.camera.fovDeg) / 2.0;
    const double focalPx = sight.height / 2.0 / std::tan(halfFov);
    const double aspect = static_cast<double>(sight.width) / sight.height;
    const double tangent = std::tan(halfFov);
    const double secant = std::sqrt(1.0 + tangent * tangent * (1.0 + aspect * aspect));
    const double distance = smallest > 0.0 ? distanceTo(bounds, viewFromObject, smallest) : 0.0;
    const double depth = std::max(sight.camera.near, distance / secant);
    const double errorView = sight.errorPx * depth / (focalPx * secant + sight.errorPx);
    const double errorObject = errorView / std::max(1e-300, largest);

    generator::Fineness fine{};
    fine.error = std::exp2(std::floor(2.0 * std::log2(errorObject)) / 2.0);
    const double radius = glm::length(bounds.max - bounds.min) / 2.0 * largest;
    // The plan's error option moves the shading's bound along: error falls with the square.
    double wish =
        shadingDivisions(sight.shading, radius * focalPx / depth) * std::sqrt(0.25 / sight.errorPx);
    // Coordinates are linear within a triangle: at poles and apexes that shows first.
    if (textured) wish *= 2.0;
    fine.fullTurn = generator::ladder(std::clamp(wish, 8.0, generator::kMostDivisions));
    // Eight carry vertex lighting and normals round an apex; a texture wants them finer.
    fine.straightSide = textured ? fine.fullTurn : std::min(8.0, fine.fullTurn);
    return fine;
}

}  // namespace farol::render
