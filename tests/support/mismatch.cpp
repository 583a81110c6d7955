#include "tests/support/mismatch.h"

#include <algorithm>

#include "scene/files/assets.h"
#include "scene/read/reader.h"

namespace farol::test {

Mismatch mismatchOf(const reference::Picture& exact, const image::Image& image) {
    Mismatch result;
    for (int y = 0; y < exact.height; ++y)
        for (int x = 0; x < exact.width; ++x) {
            const std::size_t at = exact.at(x, y);
            const std::uint8_t* p = &image.pixels[4 * at];
            const glm::dvec3 expected = 255.0 * glm::clamp(exact.color[at], 0.0, 1.0);
            const glm::dvec3 difference = glm::abs(glm::dvec3(p[0], p[1], p[2]) - expected);
            const double off = std::max({difference.x, difference.y, difference.z});
            ++result.pixels;
            result.off += off > 2.0 ? 1 : 0;
            if (exact.edge[at] != reference::kInterior) continue;
            ++result.inside;
            if (off <= 8.0) continue;
            ++result.insideOff;
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
    return mismatchOf(reference::traceCenters(reference::makeWorld(scene, {}, options)), image);
}

}  // namespace farol::test
