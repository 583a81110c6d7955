#include "render/plan/crowd.h"

#include <algorithm>

#include "render/plan/batches.h"

namespace farol::render {
namespace {

/// Distance along the view of the middle of a model's box.
float depthOf(const DrawItem& item) {
    const Box& box = item.mesh->bounds;
    return -(item.viewFromObject * glm::vec4(glm::vec3((box.min + box.max) * 0.5), 1.0F)).z;
}

bool mayTrade(const DrawItem& a, const DrawItem& b) {
    return a.texture < 0 && !a.colored && a.depthRank == 0 && b.depthRank == 0 &&
           a.lightSet == b.lightSet && a.inside == b.inside && a.mirrored == b.mirrored &&
           sameMaterial(a, b);
}

}  // namespace

std::int64_t triangleBudget(const glm::ivec2& size) {
    return std::min<std::int64_t>(16'000'000, 1'000'000 + std::int64_t{8} * size.x * size.y);
}

void sortCrowd(std::vector<DrawItem>& items, double layers) {
    if (layers <= kSortedLayers) return;
    for (std::size_t first = 0; first < items.size();) {
        std::size_t last = first + 1;
        while (last < items.size() && mayTrade(items[first], items[last])) ++last;
        std::stable_sort(
            items.begin() + static_cast<std::ptrdiff_t>(first),
            items.begin() + static_cast<std::ptrdiff_t>(last),
            [](const DrawItem& a, const DrawItem& b) { return depthOf(a) < depthOf(b); });
        first = last;
    }
}

}  // namespace farol::render
