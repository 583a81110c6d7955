#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>

#include "generator/registry.h"
#include "render/options.h"
#include "render/plan/camera.h"
#include "render/plan/mesh_library.h"
#include "scene/scene.h"

namespace farol::render {

/// Bounds on the error of open shapes' tessellation.
struct Tolerance {
    double errorPx = 0.25;
    scene::Shading shading = scene::Shading::phong;
};

/// An exact surface as it is seen: the viewer in the surface's own units.
struct ProjectedSurface {
    generator::Surface surface;
    glm::dvec3 eye;
};

/// The exact surface of a model that stands at viewFromObject; nothing where it is flattened.
std::optional<ProjectedSurface> projectSurface(const generator::Surface& surface,
                                               const glm::dmat4& viewFromObject);

/// True where the viewer stands so close to the surface that its size hides the distance: single
/// precision cannot follow a pixel's ray to it.
bool isTooClose(const ProjectedSurface& seen);

/// The error on the screen, px, of the finest mesh of a shape for which `fineness` is the one that
/// `errorPx` asks for. 0 where the distance to the surface is not known.
double finestErrorPx(const ProjectedSurface& seen, const generator::Fineness& fineness,
                     double errorPx);

/// By which share of that its outline errs: the horizon of a round surface is farther away than its
/// nearest point.
double outlineShare(const ProjectedSurface& seen);

/// How fine a shape has to be whose bounding box is `bounds` (object space) and that stands at
/// viewFromObject, so that no point of its surface moves by more than tolerance.errorPx on the
/// screen (docs/explanation/accuracy.md), rounded down to a roundUpToStep of quarter powers of two
/// so that an orbiting camera meets the same meshes again. Curved shapes also get the divisions
/// that their shading needs, unless their pixels take it from the surface `seen`.
generator::Fineness fineness(const Box& bounds, const glm::dmat4& viewFromObject,
                             const std::optional<ProjectedSurface>& seen, bool textured,
                             const Tolerance& tolerance, const ViewTransform& view);

}  // namespace farol::render
