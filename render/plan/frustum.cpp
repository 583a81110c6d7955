#include "render/plan/frustum.h"

#include <algorithm>
#include <cmath>

namespace farol::render {
namespace {

// Single precision on the way to the picture: a few times 2^-24 of the largest coordinate.
constexpr double kSingle = 1e-6;
// Float window coordinates below 8192 are off by 1/512 px at most, no more than snapping.
constexpr double kSnapMargin = 8.0;

double sumOf(const glm::dvec3& v) { return v.x + v.y + v.z; }

}  // namespace

Frustum::Frustum(const ViewTransform& view, double errorPx)
    : eye_(view.eye), slack_(cullingSlack(view, errorPx)) {
    const double marginPx = cullingMarginPx(errorPx);
    const double tanX = view.tanHalfFov.x * (1.0 + 2.0 * marginPx / view.size.x);
    const double tanY = view.tanHalfFov.y * (1.0 + 2.0 * marginPx / view.size.y);
    const auto plane = [&](const glm::dvec3& normalEye, double offset) {
        return Plane{glm::normalize(glm::transpose(view.rotation) * normalEye), offset};
    };
    planes_ = {plane({1, 0, -tanX}, 0.0),     plane({-1, 0, -tanX}, 0.0),
               plane({0, 1, -tanY}, 0.0),     plane({0, -1, -tanY}, 0.0),
               plane({0, 0, -1}, -view.near), plane({0, 0, 1}, view.far)};
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

double cullingSlack(const ViewTransform& view, double errorPx) {
    return kSingle + 2.0 * errorPx * view.pixelAngle;
}

double cullingMarginPx(double errorPx) { return 2.0 + 2.0 * errorPx; }

std::optional<PixelRect> pixelRect(const Box& box, const glm::dmat4& viewFromObject,
                                   const ViewTransform& view) {
    const glm::dmat4 clipFromObject = view.clip * viewFromObject;
    PixelRect rect{glm::dvec2(1e300), glm::dvec2(-1e300)};
    for (int i = 0; i < 8; ++i) {
        const glm::dvec4 p = clipFromObject * glm::dvec4(box.corner(i), 1.0);
        // Depth is 1 at the near plane: beyond it w is at least z.
        if (!(p.w > 0.0) || p.z > p.w) return std::nullopt;
        const glm::dvec2 px = (glm::dvec2(p) / p.w + 1.0) * 0.5 * glm::dvec2(view.size);
        rect.min = glm::min(rect.min, px);
        rect.max = glm::max(rect.max, px);
    }
    return rect;
}

std::optional<PixelRect> visibleRect(const Box& box, const glm::dmat4& viewFromObject,
                                     const ViewTransform& view) {
    const glm::dmat4 clipFromObject = view.clip * viewFromObject;
    std::array<glm::dvec4, 8> corners;
    for (int i = 0; i < 8; ++i)
        corners[static_cast<std::size_t>(i)] = clipFromObject * glm::dvec4(box.corner(i), 1.0);
    const auto behindNear = [](const glm::dvec4& p) { return p.w - p.z; };
    std::optional<PixelRect> rect;
    const auto add = [&](const glm::dvec4& p) {
        const glm::dvec2 px = (glm::dvec2(p) / p.w + 1.0) * 0.5 * glm::dvec2(view.size);
        if (!rect) rect = {px, px};
        rect->min = glm::min(rect->min, px);
        rect->max = glm::max(rect->max, px);
    };
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double depth = behindNear(corners[i]);
        if (depth >= 0.0) add(corners[i]);
        for (const std::size_t bit : {1U, 2U, 4U}) {  // along the edges
            const glm::dvec4& other = corners[i ^ bit];
            const double otherDepth = behindNear(other);
            if (depth >= 0.0 && otherDepth < 0.0)
                add(corners[i] + (other - corners[i]) * (depth / (depth - otherDepth)));
        }
    }
    return rect;
}

double coveredArea(const std::optional<PixelRect>& rect, const glm::ivec2& size) {
    const glm::dvec2 whole(size);
    if (!rect) return whole.x * whole.y;
    const glm::dvec2 side = glm::clamp(rect->max, glm::dvec2(0.0), whole) -
                            glm::clamp(rect->min, glm::dvec2(0.0), whole);
    return std::max(0.0, side.x) * std::max(0.0, side.y);
}

bool isOutside(const Box& box, const glm::dmat4& viewFromObject, const ViewTransform& view,
               double errorPx) {
    const double marginPx = cullingMarginPx(errorPx);
    const double share = cullingSlack(view, errorPx);
    const glm::dmat4 clipFromObject = view.clip * viewFromObject;
    const double marginX = 1.0 + 2.0 * marginPx / view.size.x;
    const double marginY = 1.0 + 2.0 * marginPx / view.size.y;
    unsigned all = 0x3FU;
    for (int i = 0; i < 8 && all; ++i) {
        const glm::dvec4 p = clipFromObject * glm::dvec4(box.corner(i), 1.0);
        const double slack = share * (std::abs(p.x) + std::abs(p.y) + std::abs(p.w));
        const double w = p.w;
        unsigned out = 0;
        if (p.x < -marginX * w - slack) out |= 1U;
        if (p.x > marginX * w + slack) out |= 2U;
        if (p.y < -marginY * w - slack) out |= 4U;
        if (p.y > marginY * w + slack) out |= 8U;
        if (p.z < -slack) out |= 16U;     // beyond far
        if (p.z > w + slack) out |= 32U;  // before near
        all &= out;
    }
    return all != 0;
}

bool missesSamples(const PixelRect& rect, const SamplePattern& samples, double snapPx) {
    const double margin = kSnapMargin * snapPx;
    return std::none_of(samples.begin(), samples.end(), [&](const glm::dvec2& at) {
        const glm::dvec2 first = glm::ceil(rect.min - margin - at);
        const glm::dvec2 last = glm::floor(rect.max + margin - at);
        return first.x <= last.x && first.y <= last.y;
    });
}

}  // namespace farol::render
