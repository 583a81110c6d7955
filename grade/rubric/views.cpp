#include "grade/rubric/views.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

#include "grade/images/measures.h"
#include "render/plan/camera.h"
#include "render/plan/plan.h"
#include "scene/animation.h"

namespace farol::grade {
namespace {

constexpr int kMaxSide = 512;  // px, unless the rubric sets a size: relevant details are larger

render::PictureOptions basic(const Rubric& rubric, const scene::Scene& reference) {
    render::PictureOptions options;
    options.samples = rubric.samples;
    options.shading = rubric.shading;
    options.filter = rubric.filter;
    options.axes = rubric.axes;
    const glm::ivec2 window = render::pictureSize(reference, {});
    glm::ivec2 size(rubric.width.value_or(window.x), rubric.height.value_or(window.y));
    if (!rubric.width && !rubric.height) {
        const double scale =
            std::min(1.0, kMaxSide / static_cast<double>(std::max(size.x, size.y)));
        size = glm::max(glm::ivec2(1), glm::ivec2(glm::round(glm::dvec2(size) * scale)));
    }
    options.width = size.x;
    options.height = size.y;
    return options;
}

/// The camera turned about its target: azimuth about its up, elevation towards it, never over.
scene::Camera orbit(const scene::Camera& camera, const View& view) {
    const glm::dvec3 away = camera.eye - camera.target;
    const double distance = glm::length(away);
    const glm::dvec3 up = glm::normalize(camera.up);
    const double height = std::clamp(glm::dot(away, up) / distance, -1.0, 1.0);
    glm::dvec3 level = away - up * glm::dot(away, up);
    if (glm::length(level) < 1e-6 * distance)
        level = std::abs(up.x) < 0.9 ? glm::cross(up, glm::dvec3(1, 0, 0))
                                     : glm::cross(up, glm::dvec3(0, 1, 0));
    level = glm::dvec3(glm::rotate(glm::dmat4(1.0), glm::radians(view.azimuthDeg), up) *
                       glm::dvec4(glm::normalize(level), 0.0));
    constexpr double kSteepest = 85.0;  // degrees: the up must not be along the view
    const double elevation = glm::radians(
        std::clamp(glm::degrees(std::asin(height)) + view.elevationDeg, -kSteepest, kSteepest));
    scene::Camera out = camera;
    out.eye = camera.target +
              view.distance * distance * (std::cos(elevation) * level + std::sin(elevation) * up);
    return out;
}

}  // namespace

void useCamera(render::PictureOptions& options, const scene::Camera& camera) {
    options.eye = camera.eye;
    options.target = camera.target;
    options.up = camera.up;
    options.fovDeg = camera.fovDeg;
    options.near = camera.near;
    options.far = camera.far;
}

std::vector<double> chooseTimes(const Rubric& rubric, const scene::Scene& reference) {
    if (!rubric.timesS.empty()) return rubric.timesS;
    if (!scene::isAnimated(reference)) return {0.0};
    std::vector<double> periods;
    const std::function<void(const scene::Group&)> visit = [&](const scene::Group& group) {
        for (const scene::Transform& transform : group.transforms) {
            if (const auto* spin = std::get_if<scene::Spin>(&transform))
                periods.push_back(std::abs(spin->seconds));
            if (const auto* curve = std::get_if<scene::FollowCurve>(&transform))
                periods.push_back(curve->seconds);
        }
        for (const scene::Group& child : group.groups) visit(child);
    };
    for (const scene::Group& group : reference.groups) visit(group);
    if (periods.empty()) return {0.0, scene::kHueSeconds * 0.37};
    std::sort(periods.begin(), periods.end());
    return {0.0, 0.37 * periods[periods.size() / 2]};  // no simple part of a turn
}

std::vector<Shot> planShots(const Rubric& rubric, const scene::Scene& reference,
                            const render::Box& bounds, const std::vector<double>& timesS,
                            bool isFixed) {
    const render::PictureOptions options = basic(rubric, reference);
    const double aspect = static_cast<double>(*options.width) / *options.height;
    const scene::Camera camera = render::chooseCamera(reference, {}, bounds, aspect);
    std::vector<Shot> shots;
    for (const double timeS : timesS)
        for (const View& view : rubric.views) {
            Shot shot{view.name, view.kind == View::Kind::own, options};
            if (timesS.size() > 1) shot.name += " at " + shortNumber(timeS) + " s";
            shot.options.timeS = timeS;
            if (view.kind == View::Kind::reference || (isFixed && shot.own))
                useCamera(shot.options, camera);
            if (view.kind == View::Kind::orbit) useCamera(shot.options, orbit(camera, view));
            shots.push_back(std::move(shot));
        }
    return shots;
}

FrameParts partsFor(const Rubric& rubric) {
    FrameParts parts;
    for (const Criterion& criterion : rubric.criteria)
        if (const ImageMetric* image = criterion.metric->image();
            image != nullptr && criterion.weight > 0.0)
            parts.add(image->needs);
    return parts;
}

Frame drawFrame(render::Renderer& renderer, const render::Job& job, const Shot& shot,
                const FrameParts& parts) {
    Frame frame;
    render::Job one = job;
    one.options = shot.options;
    one.options.missing = job.options.missing;
    renderer.draw(one, frame.color);
    const auto layer = [&](render::Layer which) {
        one.options.layer = which;
        image::Image image;
        renderer.draw(one, image);
        return image;
    };
    if (parts.ids) frame.ids = idsOf(layer(render::Layer::id));
    if (parts.depth) frame.depth = layer(render::Layer::depth);
    if (parts.normals) frame.normal = layer(render::Layer::normal);
    return frame;
}

}  // namespace farol::grade
