#include "render/frustum.h"

#include <algorithm>
#include <cmath>

namespace farol::render {
namespace {

// Single precision on the way to the picture: a few times 2^-24 of the largest coordinate.
constexpr double kSingle = 1e-6;
// Snapping moves a vertex by at most 1/512 px, float window coordinates below 8192 by as much.
constexpr double kSnapPx = 1.0 / 64.0;

double sumOf(const glm::dvec3& v) { return v.x + v.y + v.z; }

}  // namespace

Frustum::Frustum(const glm::dmat3& rotation, const glm::dvec3& eye, const scene::Camera& camera,
                 const glm::ivec2& size, double errorPx)
    : eye_(eye), slack_(cullingSlack(camera, size, errorPx)) {
    const double marginPx = cullingMarginPx(errorPx);
    const double up = std::tan(glm::radians(camera.fovDeg) / 2.0);
    const double tanX = up * size.x / size.y * (1.0 + 2.0 * marginPx / size.x);
    const double tanY = up * (1.0 + 2.0 * marginPx / size.y);
    const auto plane = [&](const glm::dvec3& normalView, double offset) {
        return Plane{glm::normalize(glm::transpose(rotation) * normalView), offset};
    };
    planes_ = {plane({1, 0, -tanX}, 0.0),       plane({-1, 0, -tanX}, 0.0),
               plane({0, 1, -tanY}, 0.0),       plane({0, -1, -tanY}, 0.0),
               plane({0, 0, -1}, -camera.near), plane({0, 0, 1}, camera.far)};
}

Frustum::Side Frustum::test(const Box& box, unsigned& planes) const {
    const glm::dvec3 center = (box.min + box.max) * 0.5 - eye_;
    const glm::dvec3 half = (box.max - box.min) * 0.5;
    const double slack = slack_ * (sumOf(glm::abs(center)) + sumOf(half));
    for (unsigned i = 0; i < planes_.size(); ++i) {
        if (!(planes & (1U << i))) continue;
        const double distance = glm::dot(planes_[i].normal, center) + planes_[i].offset;
        const double reach = glm::dot(glm::abs(planes_[i].normal), half) + slack;
        if (distance < -reach) return Side::outside;
        if (distance > reach) planes &= ~(1U << i);
    }
    return planes ? Side::straddles : Side::inside;
}

double cullingSlack(const scene::Camera& camera, const glm::ivec2& size, double errorPx) {
    return kSingle + 2.0 * errorPx * 2.0 * std::tan(glm::radians(camera.fovDeg) / 2.0) / size.y;
}

double cullingMarginPx(double errorPx) { return 2.0 + 2.0 * errorPx; }

std::optional<PixelRect> pixelRect(const Box& box, const glm::dmat4& clipFromObject,
                                   const glm::ivec2& size) {
    PixelRect rect{glm::dvec2(1e300), glm::dvec2(-1e300)};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 p = clipFromObject * glm::dvec4(corner & 1 ? box.max.x : box.min.x,
                                                         corner & 2 ? box.max.y : box.min.y,
                                                         corner & 4 ? box.max.z : box.min.z, 1.0);
        // Depth is 1 at the near plane: beyond it w is at least z.
        if (!(p.w > 0.0) || p.z > p.w) return std::nullopt;
        const glm::dvec2 px = (glm::dvec2(p) / p.w + 1.0) * 0.5 * glm::dvec2(size);
        rect.min = glm::min(rect.min, px);
        rect.max = glm::max(rect.max, px);
    }
    return rect;
}

bool missesSamples(const PixelRect& rect, const SamplePattern& samples) {
    return std::none_of(samples.begin(), samples.end(), [&](const glm::dvec2& at) {
        const glm::dvec2 first = glm::ceil(rect.min - kSnapPx - at);
        const glm::dvec2 last = glm::floor(rect.max + kSnapPx - at);
        return first.x <= last.x && first.y <= last.y;
    });
}

}  // namespace farol::render
