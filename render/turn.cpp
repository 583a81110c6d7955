#include "render/turn.h"

#include <glm/gtx/rotate_vector.hpp>

namespace farol::render {

void turnEye(PictureOptions& options, const scene::Camera& first, double angle) {
    options.orbit = {};
    options.eye =
        first.target + glm::rotate(first.eye - first.target, angle, glm::normalize(first.up));
    options.target = first.target;
    options.up = first.up;
    options.fovDeg = first.fovDeg;
    options.near = first.near;
    options.far = first.far;
}

}  // namespace farol::render
