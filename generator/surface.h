#pragma once

#include <glm/glm.hpp>
#include <string_view>
#include <vector>

namespace farol::generator {

struct Surface;

/// One kind of exact surface: its functions for tessellation and its part of the fragment shader.
/// Defined in the shape's source file, one object a kind.
struct SurfaceKind {
    /// Distance from `eye` to the curved part, in the surface's units. Null: not known.
    double (*distance)(const Surface& surface, const glm::dvec3& eye) = nullptr;
    /// True if the fragments of a mesh with this many divisions of a full turn must intersect
    /// their rays with the surface. It costs them up to half as much again. It pays if the outline
    /// needs fewer divisions than interpolation does, or if interpolation never suffices (the tips
    /// of textures, cones).
    bool (*isNeeded)(const Surface& surface, double fullTurn, bool textured) = nullptr;
    /// Divisions of a full turn, in the coarser direction, of a mesh with these level arguments.
    double (*fullTurn)(const std::vector<double>& levels) = nullptr;
    /// The scale, object space, that makes that mesh err equally outwards and inwards.
    glm::dvec3 (*balance)(const std::vector<double>& levels) = nullptr;

    bool isBall = false;      ///< with equal lengths
    bool hasProfile = false;  ///< its outline is the mesh's own, and so are its normals along it
    bool hasCaps = false;     ///< has flat parts, whose normals are +Y or -Y
    bool wrapsV = false;      ///< v runs round too
    int raySteps = 0;         ///< a ray's steps to it: 0: the mesh lies in it; 1: a quadric
    /// Functions that render/gl/shaders/surface.glsl declares; "" with hasProfile.
    std::string_view glsl = {};
};

/// The exact surface that the mesh of a curved shape stands for, in units of its lengths:
/// q = position / lengths.
struct Surface {
    const SurfaceKind* kind = nullptr;
    glm::dvec3 lengths{1.0};
    glm::dvec2 form{0.0};  ///< proportions, defined by the kind
    /// Texture coordinates of the curved part: u = uv.x + uv.y * turn, v = uv.z + uv.w * share. The
    /// turn 0..1 about Y runs from +Z towards +X (from +X towards -Z with turnFromX); the share
    /// 0..1 from pole to pole, up the side, about the tube, or from hole to rim; of a turned
    /// profile it is the mesh's own.
    glm::dvec4 uv{0.0, 1.0, 0.0, 1.0};
    /// Where the discs that close a frustum have their middles in the texture: bottom, top.
    glm::dvec4 discs{0.5};
    bool turnFromX = false;
    bool discUv = false;  ///< instead u = uv.x + uv.y * q.x, v = uv.z + uv.w * q.z
    bool operator==(const Surface&) const = default;
};

/// Interpolated from 64 divisions of a full turn, highlights of shininess 12 keep a p99.9 of 2 to 4
/// levels; with fewer than this many, pixels follow their rays.
inline constexpr double kSmoothTurn = 128.0;

/// Distance in the plane from `eye` to the straight line between two points.
double distanceToSegment(const glm::dvec2& eye, const glm::dvec2& from, const glm::dvec2& to);

/// The radius about Y and the height of a point.
glm::dvec2 aboutY(const glm::dvec3& point);

/// SurfaceKind::fullTurn where the first level alone goes round.
double fullTurnOfSlices(const std::vector<double>& levels);

/// SurfaceKind::balance of a shape with so many slices about Y.
glm::dvec3 balanceOfSlices(double slices);

}  // namespace farol::generator
