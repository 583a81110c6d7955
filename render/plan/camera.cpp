#include "render/plan/camera.h"

#include <algorithm>
#include <cmath>

#include "render/plan/messages.h"

namespace farol::render {
namespace {

/// A sphere round all that there is; of radius 1 about the origin where there is nothing.
struct Ball {
    glm::dvec3 center{0.0};
    double radius = 1.0;
};

Ball ballOf(const Box& bounds) {
    if (bounds.empty()) return {};
    const double radius = glm::length(bounds.max - bounds.min) * 0.5;
    return {(bounds.min + bounds.max) * 0.5, radius > 1e-9 ? radius : 1.0};
}

/// Sees all of the ball from front right above.
scene::Camera framing(const Ball& ball, double aspect) {
    scene::Camera camera;
    const double halfUp = glm::radians(camera.fovDeg) / 2.0;
    const double halfAcross = std::atan(std::tan(halfUp) * aspect);
    const double distance = 1.05 * ball.radius / std::sin(std::min(halfUp, halfAcross));
    camera.target = ball.center;
    camera.eye = ball.center + distance * glm::normalize(glm::dvec3(0.5, 0.45, 1.0));
    return camera;
}

/// Fits the near and far planes to the ball, unless the options set them.
void fitDepth(scene::Camera& camera, const Ball& ball, const PictureOptions& options) {
    const double distance = glm::length(camera.eye - ball.center);
    camera.far = options.far.value_or(distance + 2.0 * ball.radius);
    camera.near = options.near.value_or(std::max(
        distance - 1.1 * ball.radius, 1e-3 * std::min(camera.far, distance + ball.radius)));
    if (!options.near && camera.near >= camera.far) camera.near = 1e-3 * camera.far;
}

glm::dmat3 rotationOf(const scene::Camera& camera) {
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    glm::dvec3 up = camera.up;
    const double size = glm::length(up);
    if (!(size > 0.0) || glm::length(glm::cross(forward, up)) <= 1e-9 * size) {
        const glm::dvec3 along = glm::abs(forward);
        up = along.x <= along.y && along.x <= along.z ? glm::dvec3(1, 0, 0)
             : along.z <= along.y                     ? glm::dvec3(0, 0, 1)
                                                      : glm::dvec3(0, 1, 0);
        // Straight up or down: -Z is up, as on a map.
        if (along.y > along.x && along.y > along.z) up = glm::dvec3(0, 0, -1);
    }
    const glm::dvec3 right = glm::normalize(glm::cross(forward, up));
    return glm::transpose(glm::dmat3(right, glm::cross(right, forward), -forward));
}

/// Nothing: a view that frames all models.
std::optional<scene::Camera> startOf(const scene::Scene& scene, const PictureOptions& options) {
    if (options.camera == CameraStart::engine) return scene::engineCamera();
    return options.camera == CameraStart::scene ? scene.camera : std::nullopt;
}

[[noreturn]] void fail(Message message, const std::string& field) {
    throw Error(std::move(message), {}, field);
}

}  // namespace

scene::Camera chooseCamera(const scene::Scene& scene, const PictureOptions& options,
                           const Box& bounds, double aspect) {
    const Ball ball = ballOf(bounds);
    const std::optional<scene::Camera> start = startOf(scene, options);
    scene::Camera camera = start ? *start : framing(ball, aspect);
    if (options.target) camera.target = *options.target;
    if (options.up) camera.up = *options.up;
    if (options.fovDeg) camera.fovDeg = *options.fovDeg;
    if (options.near) camera.near = *options.near;
    if (options.far) camera.far = *options.far;
    if (options.eye) {
        if (options.orbit.isSet()) fail(message<"option.camera/orbit">(), "eye");
        camera.eye = *options.eye;
    } else if (options.orbit.isSet()) {
        // Values that are not given are those of the scene's camera.
        const glm::dvec3 arm = camera.eye - camera.target;
        const double length = glm::length(arm);
        const double distance = options.orbit.distance.value_or(length);
        const double azimuth = options.orbit.azimuthDeg ? glm::radians(*options.orbit.azimuthDeg)
                                                        : std::atan2(arm.x, arm.z);
        const double elevation = options.orbit.elevationDeg
                                     ? glm::radians(*options.orbit.elevationDeg)
                                     : std::atan2(arm.y, std::hypot(arm.x, arm.z));
        camera.eye = camera.target + distance * glm::dvec3(std::cos(elevation) * std::sin(azimuth),
                                                           std::sin(elevation),
                                                           std::cos(elevation) * std::cos(azimuth));
    }
    if (!start) fitDepth(camera, ball, options);
    const glm::dvec3 view = camera.target - camera.eye;
    const double scale = std::max({1e-30, glm::length(camera.target), glm::length(camera.eye)});
    if (!(glm::length(view) > 1e-12 * scale)) fail(message<"option.camera/same-point">(), "eye");
    if (!(camera.far > camera.near))
        fail(message<"option.camera/far">("far"_arg = camera.far, "near"_arg = camera.near), "far");
    return camera;
}

std::optional<Diagnostic> noteCameraStart(const scene::Scene& scene,
                                          const PictureOptions& options) {
    // A mesh alone has no camera, and with both points given the start does not matter.
    if (scene.where.line == 0 || (options.eye && options.target)) return std::nullopt;
    Message start;
    if (options.camera == CameraStart::engine)
        start = message<"scene.camera-start/engine">();
    else if (options.camera == CameraStart::framed)
        start = message<"scene.camera-start/framed">();
    else if (!scene.camera)
        start = message<"scene.camera-start/none">();
    else
        return std::nullopt;
    return diagnosticOf(Severity::info, std::move(start), scene.where);
}

ViewTransform viewOf(const scene::Camera& camera, const glm::ivec2& size) {
    ViewTransform view;
    view.rotation = rotationOf(camera);
    view.eye = camera.eye;
    const double up = std::tan(glm::radians(camera.fovDeg) / 2.0);
    const double aspect = static_cast<double>(size.x) / size.y;
    view.tanHalfFov = {up * size.x / size.y, up};
    view.pixelAngle = 2.0 * up / size.y;
    view.near = camera.near;
    view.far = camera.far;
    view.size = size;
    const double range = camera.far - camera.near;
    view.clip = glm::dmat4(0.0);
    view.clip[0][0] = 1.0 / up / aspect;
    view.clip[1][1] = 1.0 / up;
    view.clip[2][2] = camera.near / range;
    view.clip[2][3] = -1.0;
    view.clip[3][2] = camera.near * camera.far / range;
    return view;
}

glm::dmat4 movedClip(const ViewTransform& view, const glm::dvec2& offset) {
    glm::dmat4 clip = view.clip;
    clip[2][0] = 2.0 * offset.x / view.size.x;
    clip[2][1] = 2.0 * offset.y / view.size.y;
    return clip;
}

}  // namespace farol::render
