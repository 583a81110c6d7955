#include "render/plan/tessellate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace farol::render {
namespace {

/// Distance from the viewer to the curved part, in the surface's units; 0 where it is not known.
double unitDistance(const ProjectedSurface& seen) {
    const auto distance = seen.surface.kind->distance;
    return distance != nullptr ? distance(seen.surface, seen.eye) : 0.0;
}

/// Distance from the viewer to the surface, view units, or less; 0 where nothing is known.
double distanceTo(const Box& bounds, const glm::dmat4& viewFromObject,
                  const std::optional<ProjectedSurface>& seen, double smallest) {
    const glm::dvec3 eye(glm::inverse(viewFromObject) * glm::dvec4(0, 0, 0, 1));
    const glm::dvec3 outside = glm::max(glm::max(bounds.min - eye, eye - bounds.max), 0.0);
    double distance = glm::length(outside);
    if (seen) {
        const glm::dvec3& lengths = seen->surface.lengths;
        distance =
            std::max(distance, unitDistance(*seen) * std::min({lengths.x, lengths.y, lengths.z}));
    }
    // Within the box of a shape that is not known the surface may be anywhere: 0.
    return smallest * distance;
}

/// A ball's projected error is largest neither in front, where the error is along the view, nor at
/// its rim, which is farther: an error e projects to at most e D / |D^2 - r^2| (the largest value
/// of sin(view, normal) / distance). Returns the inverse of that factor, a distance; 0 for
/// surfaces that are no ball.
double ballDistance(const ProjectedSurface& seen, const glm::dvec3& center,
                    const glm::dvec3& columns) {
    if (!seen.surface.kind->isBall) return 0.0;
    const glm::dvec3 radii = columns * seen.surface.lengths;
    const double r = std::max({radii.x, radii.y, radii.z});
    if (std::min({radii.x, radii.y, radii.z}) < (1.0 - 1e-9) * r) return 0.0;
    const double d = glm::length(center);
    // From the very middle nothing would be seen of it; its depth still counts.
    return std::min(std::abs(d * d - r * r) / std::max(1e-300, d), d + r);
}

/// Secant of the largest angle from the view's axis at which the ball is seen, the window's corner
/// at most: by its square an error grows on the screen.
double farthestSecant(const glm::dvec3& center, double radius, const ViewTransform& view) {
    const double corner = std::sqrt(1.0 + glm::dot(view.tanHalfFov, view.tanHalfFov));
    const double d = glm::length(center);
    if (!(d > radius)) return corner;
    const double angle = std::acos(glm::clamp(-center.z / d, -1.0, 1.0)) + std::asin(radius / d);
    return std::cos(angle) * corner > 1.0 ? 1.0 / std::cos(angle) : corner;
}

/// Divisions of a full turn below which interpolated normals and texture coordinates are off by
/// more than about half a level of 255 (measured on a unit sphere with shininess 50: rms 0.87 at 32
/// and 0.24 at 64 slices lit per pixel, 0.94 at 64 and 0.25 at 128 lit per vertex).
double shadingDivisions(scene::Shading shading, double radiusPx) {
    double divisions = 8.0;
    if (shading == scene::Shading::phong || shading == scene::Shading::solid) divisions = 48.0;
    if (shading == scene::Shading::gouraud) divisions = 96.0;
    // The highlight of an object of a few pixels is invisible.
    if (radiusPx < 4.0) divisions = std::min(divisions, 16.0);
    if (radiusPx < 1.0) divisions = 8.0;
    return divisions;
}

}  // namespace

std::optional<ProjectedSurface> projectSurface(const generator::Surface& surface,
                                               const glm::dmat4& viewFromObject) {
    glm::dmat3 viewFromUnit(viewFromObject);
    double largest = 0.0;
    for (int i = 0; i < 3; ++i) {
        viewFromUnit[i] *= surface.lengths[i];
        largest = std::max(largest, glm::length(viewFromUnit[i]));
    }
    // Of 24 bits, ten are left for the ray in the worst case.
    constexpr double kFlattest = 1e-4;
    if (!(std::abs(glm::determinant(viewFromUnit)) > kFlattest * largest * largest * largest))
        return std::nullopt;
    const glm::dvec3 center(viewFromObject[3]);
    return ProjectedSurface{surface, -(glm::inverse(viewFromUnit) * center)};
}

bool isTooClose(const ProjectedSurface& seen) {
    constexpr double kNearest = 1e-3;
    return seen.surface.kind->raySteps > 0 && unitDistance(seen) < kNearest;
}

double finestErrorPx(const ProjectedSurface& seen, const generator::Fineness& fineness,
                     double errorPx) {
    const double near = unitDistance(seen);
    if (!(near > 0.0)) return 0.0;
    const glm::dvec3& lengths = seen.surface.lengths;
    const double radius = std::max({lengths.x, lengths.y, lengths.z});
    const double half = std::sin(std::numbers::pi / generator::kMaxDivisions);
    // The middle of a ball's facet is twice as deep as that of a chord.
    double depth = radius * half * half * (seen.surface.kind->isBall ? 1.0 : 0.5);
    if (fineness.balanced) depth *= 0.5;
    return errorPx * depth / fineness.error;
}

double outlineShare(const ProjectedSurface& seen) {
    const double near = unitDistance(seen);
    return near > 0.0 ? std::min(1.0, std::sqrt(near / (2.0 + near))) : 1.0;
}

generator::Fineness fineness(const Box& bounds, const glm::dmat4& viewFromObject,
                             const std::optional<ProjectedSurface>& seen, bool textured,
                             const Tolerance& tolerance, const ViewTransform& view) {
    const glm::dmat3 linear(viewFromObject);
    // Singular values: square roots of the eigenvalues of the Gram matrix. The Frobenius norm
    // bounds the largest within sqrt(3), the determinant over its square the smallest: loose
    // bounds would cost triangles, so the columns of an orthogonal scale are used as they are.
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

    const double focalPx = 1.0 / view.pixelAngle;
    const double radius = glm::length(bounds.max - bounds.min) / 2.0 * largest;
    const glm::dvec3 center(viewFromObject * glm::dvec4((bounds.min + bounds.max) / 2.0, 1.0));
    const double secant = farthestSecant(center, radius, view);
    double distance = smallest > 0.0 ? distanceTo(bounds, viewFromObject, seen, smallest) : 0.0;
    if (seen && orthogonal) distance = std::max(distance, ballDistance(*seen, center, columns));
    const double depth = std::max(view.near, distance / secant);
    const double errorView = tolerance.errorPx * depth / (focalPx * secant + tolerance.errorPx);
    const double errorObject = errorView / std::max(1e-300, largest);

    generator::Fineness fine{};
    fine.textured = textured;
    fine.error = std::exp2(std::floor(4.0 * std::log2(errorObject)) / 4.0);
    if (seen && !seen->surface.kind->hasProfile) {
        fine.fullTurn = 8.0;
        fine.straightSide = 1.0;
        fine.balanced = true;
        return fine;
    }
    // The plan's error option moves the shading's bound along: error falls with the square.
    double requiredDivisions = shadingDivisions(tolerance.shading, radius * focalPx / depth) *
                               std::sqrt(0.25 / tolerance.errorPx);
    // Coordinates are linear within a triangle: at poles and apexes that shows first.
    if (textured) requiredDivisions *= 2.0;
    // A turned profile's pixels know their normals, but not where beside the facet the surface is.
    if (seen) requiredDivisions *= 1.25;
    fine.fullTurn =
        generator::roundUpToStep(std::clamp(requiredDivisions, 8.0, generator::kMaxDivisions));
    // Eight carry vertex lighting and normals round an apex; a texture wants them finer.
    fine.straightSide = textured ? fine.fullTurn : std::min(8.0, fine.fullTurn);
    return fine;
}

}  // namespace farol::render
