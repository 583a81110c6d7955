#pragma once

#include <glm/glm.hpp>

#include "render/mesh_library.h"
#include "render/options.h"
#include "scene/scene.h"

namespace farol::render {

/// The camera that a picture is taken with: the request's options over the scene's camera over a
/// view that frames `bounds` (world space; may be empty). Throws Error option.camera when the
/// options leave no view (eye at target, far <= near).
scene::Camera chooseCamera(const scene::Scene& scene, const PictureOptions& options,
                           const Box& bounds, double aspect);

/// viewFromWorld without its translation: rows right, up, backward; the eye is subtracted in
/// double before anything becomes float. An up along the view is replaced by the axis least
/// aligned with it.
glm::dmat3 viewRotation(const scene::Camera& camera);

/// Reversed depth: 1 at near, 0 at far, for a clip volume of [0,1] (glClipControl). `offset` moves
/// the picture by fractions of the window (-1..1 of half of it), for antialiasing passes.
glm::dmat4 clipFromView(const scene::Camera& camera, double aspect, const glm::dvec2& offset);

}  // namespace farol::render
