#include "render/plan/ball_cap.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace farol::render {
namespace {

using glm::dvec3;

constexpr double kMaxRings = 2048, kMaxSlices = 2048;
constexpr double kMaxVertices = 500'000;
/// Heights in radii below which doubles keep fewer than three digits.
constexpr double kLowest = 1e-13;

struct Frame {
    dvec3 up, right, ahead;  ///< unit; up from the ball's middle to the viewer
};

Frame frameOf(const dvec3& eye) {
    const dvec3 up = glm::normalize(eye), along = glm::abs(up);
    const dvec3 aside = along.x <= along.y && along.x <= along.z ? dvec3(1, 0, 0)
                        : along.y <= along.z                     ? dvec3(0, 1, 0)
                                                                 : dvec3(0, 0, 1);
    const dvec3 right = glm::normalize(glm::cross(up, aside));
    return {up, right, glm::cross(up, right)};
}

/// Distance in radii from the viewer to the points at that angle from the one beneath it.
double distanceAt(double height, double angle) {
    const double half = std::sin(angle / 2.0);
    return std::sqrt(height * height + 4.0 * (1.0 + height) * half * half);
}

/// Angles of the rings, growing from 0 to `last`. Between two of them a chord is at most
/// (their difference)^2 / 8 beneath the ball, seen at the distance of the nearer one.
std::vector<double> ringsOf(double height, double last, double share) {
    std::vector<double> angles{0.0};
    while (angles.back() < last) {
        const double step = std::sqrt(8.0 * share * distanceAt(height, angles.back()));
        if (!(step > 0.0) || static_cast<double>(angles.size()) > kMaxRings) return {};
        angles.push_back(std::min(angles.back() + step, last));
    }
    return angles;
}

/// Slices of which the chords on any ring are at most `share` of its distance beneath the ball.
double slicesOf(double height, double last, double share) {
    double most = 0.0;
    constexpr int kSteps = 64;
    for (int i = 1; i <= kSteps; ++i) {
        const double angle = last * i / kSteps, across = std::sin(angle);
        most = std::max(most, across * across / distanceAt(height, angle));
    }
    return std::max(16.0, std::ceil(std::numbers::pi * std::sqrt(most / (2.0 * share))));
}

}  // namespace

std::optional<BallCap> ballCap(const generator::Surface& surface, const glm::dmat4& worldFromObject,
                               const ViewTransform& view, double errorPx) {
    if (!surface.kind->isBall) return std::nullopt;
    glm::dmat3 worldFromUnit(worldFromObject);
    for (int k = 0; k < 3; ++k) worldFromUnit[k] *= surface.lengths[k];
    const dvec3 sizes(glm::length(worldFromUnit[0]), glm::length(worldFromUnit[1]),
                      glm::length(worldFromUnit[2]));
    const double largest = std::max({sizes.x, sizes.y, sizes.z});
    const double volume = std::abs(glm::determinant(worldFromUnit / largest));
    if (!(volume > 1e-9)) return std::nullopt;
    BallCap cap;
    cap.eye = glm::inverse(worldFromUnit) * (view.eye - dvec3(worldFromObject[3]));
    const double height = (glm::dot(cap.eye, cap.eye) - 1.0) / (glm::length(cap.eye) + 1.0);
    if (!(std::abs(height) > kLowest)) return std::nullopt;

    // The projected error grows by the secant's square towards the corners; stretched balls err by
    // the largest of their half axes and are as near as the smallest.
    const double secant2 = 1.0 + glm::dot(view.tanHalfFov, view.tanHalfFov);
    const double stretch = 1.0 / volume;
    const double last =
        height > 0.0 ? std::atan(std::sqrt(height * (2.0 + height))) : std::numbers::pi;
    cap.errorPx = errorPx;
    std::vector<double> angles;
    double slices = 0.0;
    for (;; cap.errorPx *= 2.0) {  // half of the error for rings, half for slices
        const double share = 0.5 * cap.errorPx * view.pixelAngle / (secant2 * stretch);
        angles = ringsOf(height, last, share);
        slices = slicesOf(height, last, share);
        if (!angles.empty() && slices <= kMaxSlices &&
            static_cast<double>(angles.size()) * slices <= kMaxVertices)
            break;
    }

    const Frame frame = frameOf(cap.eye);
    const auto around = static_cast<std::uint32_t>(slices);
    std::vector<dvec3>& points = cap.mesh.fromEye;
    const auto add = [&](double angle, double turn) {
        const double half = std::sin(angle / 2.0);
        const dvec3 aside = frame.right * std::cos(turn) + frame.ahead * std::sin(turn);
        // Without cancellation: cos(angle) - 1 = -2 sin^2(angle / 2).
        points.push_back(surface.lengths *
                         (std::sin(angle) * aside - frame.up * (height + 2.0 * half * half)));
    };
    add(0.0, 0.0);
    for (std::size_t ring = 1; ring < angles.size(); ++ring)
        for (std::uint32_t i = 0; i < around; ++i)
            add(angles[ring], 2.0 * std::numbers::pi * i / around);
    generator::MeshArrays& arrays = cap.mesh.arrays;
    const auto at = [&](std::size_t ring, std::uint32_t i) {
        return ring == 0 ? 0U : 1U + static_cast<std::uint32_t>(ring - 1) * around + i % around;
    };
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        arrays.indices.insert(arrays.indices.end(), {a, b, c});
    };
    for (std::size_t ring = 0; ring + 1 < angles.size(); ++ring)
        for (std::uint32_t i = 0; i < around; ++i) {
            triangle(at(ring, i), at(ring + 1, i), at(ring + 1, i + 1));
            if (ring > 0) triangle(at(ring, i), at(ring + 1, i + 1), at(ring, i + 1));
        }
    arrays.normals.assign(points.size(), glm::vec3(0.0F, 1.0F, 0.0F));  // the surface has its own
    arrays.uvs.assign(points.size(), glm::vec2(0.0F));
    return cap;
}

}  // namespace farol::render
