#include "tests/support/mismatch.h"

#include <algorithm>
#include <cmath>

#include "scene/files/assets.h"
#include "scene/read/reader.h"

namespace farol::test {
namespace {

constexpr double kMostOff = 8.0;  ///< levels, inside outlines

/// Largest difference of a channel, levels.
double difference(const std::uint8_t* pixel, const glm::dvec3& color) {
    const glm::dvec3 off =
        glm::abs(glm::dvec3(pixel[0], pixel[1], pixel[2]) - 255.0 * glm::clamp(color, 0.0, 1.0));
    return std::max({off.x, off.y, off.z});
}

/// True where a ray within kBesidePx of the pixel's middle sees its colour: what is thinner than a
/// pixel has its outline between the middles of pixels.
bool isBeside(const reference::World& world, int x, int y, const std::uint8_t* pixel) {
    constexpr int kRays = 32, kRings = 4;
    for (int ring = 1; ring <= kRings; ++ring)
        for (int k = 0; k < kRays; ++k) {
            const double turn = k * (6.28318530717959 / kRays), radius = kBesidePx * ring / kRings;
            const reference::Sample sample = reference::trace(
                world, x + 0.5 + radius * std::cos(turn), y + 0.5 + radius * std::sin(turn));
            if (difference(pixel, sample.color) <= kMostOff) return true;
        }
    return false;
}

}  // namespace

Mismatch mismatchOf(const reference::World& world, const image::Image& image) {
    const reference::Picture exact = reference::traceCenters(world);
    Mismatch result;
    for (int y = 0; y < exact.height; ++y)
        for (int x = 0; x < exact.width; ++x) {
            const std::size_t at = exact.at(x, y);
            const std::uint8_t* p = &image.pixels[4 * at];
            const double off = difference(p, exact.color[at]);
            ++result.pixels;
            result.off += off > 2.0 ? 1 : 0;
            if (exact.edge[at] != reference::kInterior) continue;
            ++result.inside;
            if (off <= kMostOff) continue;
            ++result.insideOff;
            if (isBeside(world, x, y, p)) {
                ++result.beside;
                continue;
            }
            if (off <= result.worst) continue;
            result.worst = off;
            result.worstX = x;
            result.worstY = y;
        }
    return result;
}

Mismatch mismatchOf(const std::string& xml, const image::Image& image) {
    const scene::Scene scene = scene::read(xml, {}, scene::BundleAssets()).scene;
    reference::Options options;
    options.width = image.width;
    options.height = image.height;
    return mismatchOf(reference::makeWorld(scene, {}, options), image);
}

}  // namespace farol::test
