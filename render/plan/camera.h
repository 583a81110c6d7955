#pragma once

#include <glm/glm.hpp>

#include "render/options.h"
#include "render/plan/mesh_library.h"
#include "scene/scene.h"

namespace farol::render {

/// Returns the camera of an image: the request's options over its start (PictureOptions::camera),
/// which may be a view that frames `bounds` (world space; may be empty). Throws Error option.camera
/// when the options leave no view (eye at target, far <= near).
scene::Camera chooseCamera(const scene::Scene& scene, const PictureOptions& options,
                           const Box& bounds, double aspect);

/// Returns an info about the start of the camera where it is not the scene's own <camera>.
std::optional<Diagnostic> noteCameraStart(const scene::Scene& scene, const PictureOptions& options);

/// The camera as plan and painter use it. World space is where its scene stands; eye space has
/// the viewer at the origin, looking along -Z. All of it is in double: matrices become float only
/// relative to the eye.
struct ViewTransform {
    glm::dmat3 rotation{1.0};  ///< eyeFromWorld without its translation: right, up, backward
    glm::dvec3 eye{0.0};       ///< world space
    /// clipFromEye. Reversed depth, for a clip volume of [0,1] (glClipControl): 1 at near, 0 at
    /// far.
    glm::dmat4 clip{1.0};
    glm::dvec2 tanHalfFov{1.0};  ///< across and up
    double pixelAngle = 1.0;     ///< tangent of the angle of a pixel in the middle
    double near = 1.0, far = 1000.0;
    glm::ivec2 size{1};  ///< of the image, px

    glm::dvec3 eyeFromWorld(const glm::dvec3& point) const { return rotation * (point - eye); }
};

/// Precondition: a camera of chooseCamera. An up along the view is replaced by the axis least
/// aligned with it.
ViewTransform viewOf(const scene::Camera& camera, const glm::ivec2& size);

/// The view's clip matrix for an image that is moved by `offset`, px.
glm::dmat4 movedClip(const ViewTransform& view, const glm::dvec2& offset);

}  // namespace farol::render
