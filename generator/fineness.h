#pragma once

#include <cstddef>

namespace farol::generator {

/// Tessellation bounds of a mesh whose divisions a scene leaves open.
struct Fineness {
    double error;     ///< most distance between mesh and surface, object space, > 0
    double fullTurn;  ///< least divisions of a full turn at any error, for shading; >= 8
    /// Least divisions of a straight side that narrows (cone, frustum): texture coordinates and
    /// vertex lighting bend there although the surface does not. >= 1.
    double straightSide = 1;
    /// The mesh will be scaled by balancedScale and then errs to both sides: chords may be twice
    /// as deep.
    bool balanced = false;
    /// Texture coordinates are interpolated: `error` bounds how far they slide, too.
    bool textured = false;
};

/// Upper bound of the chosen divisions.
inline constexpr double kMaxDivisions = 1024;

/// Divisions of a circle of that radius whose sagitta r(1 - cos(pi/n)) is at most `error`,
/// computed without cancellation, and at least fineness.fullTurn; rounded up by roundUpToStep.
/// With fineness.balanced, of a circle that will be scaled so as to err by `error` to both sides.
double circleDivisions(double radius, double error, const Fineness& fineness);

/// Divisions of a full turn of a sphere, half as many from pole to pole, whose facets are at most
/// `error` from it; as circleDivisions.
double sphereDivisions(double radius, double error, const Fineness& fineness);

/// Returns the next of 1 2 3 4 6 8 12 16 20 24 28 32 40 48 56 64 80 ... kMaxDivisions: few levels,
/// so that cached meshes are reused while the camera moves. From 8 on they are multiples of 4:
/// bounding boxes stay exact.
double roundUpToStep(double divisions);

}  // namespace farol::generator
