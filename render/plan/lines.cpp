#include "render/plan/lines.h"

namespace farol::render {
namespace {

constexpr double kAxisLength = 100.0;  // as the course draws them

void addSegment(FramePlan& plan, const glm::dvec3& a, const glm::dvec3& b, const glm::vec3& color) {
    plan.lines.push_back({glm::vec3(plan.view.eyeFromWorld(a)), color});
    plan.lines.push_back({glm::vec3(plan.view.eyeFromWorld(b)), color});
}

void addAxes(FramePlan& plan) {
    for (int i = 0; i < 3; ++i) {
        glm::dvec3 end(0.0);
        end[i] = kAxisLength;
        glm::vec3 color(0.0F);
        color[i] = 1.0F;
        addSegment(plan, -end, end, color);
    }
}

/// The edges of a cube round the camera's target.
void addFocus(FramePlan& plan) {
    const glm::dvec3& target = plan.camera.target;
    // One fiftieth of the distance: as large at any zoom.
    const double half = glm::length(plan.camera.eye - target) / 100.0;
    const auto corner = [&](int bits) {
        return target + half * glm::dvec3(bits & 1 ? 1 : -1, bits & 2 ? 1 : -1, bits & 4 ? 1 : -1);
    };
    for (int i = 0; i < 8; ++i)
        for (int axis = 0; axis < 3; ++axis)
            if (!(i & (1 << axis)))
                addSegment(plan, corner(i), corner(i | (1 << axis)), glm::vec3(1.0F));
}

}  // namespace

void addLines(FramePlan& plan, const scene::Scene& scene, const InstanceList& list,
              const PictureOptions& options) {
    if (options.axes.value_or(scene.settings.axes.value_or(false))) addAxes(plan);
    for (const PlacedCurve& curve : list.curves)
        for (std::size_t i = 0; i < curve.points.size(); ++i)
            addSegment(plan, curve.points[i], curve.points[(i + 1) % curve.points.size()],
                       glm::vec3(1.0F));
    if (options.focus) addFocus(plan);
}

}  // namespace farol::render
