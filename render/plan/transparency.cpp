#include "render/plan/transparency.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace farol::render {
namespace {

using image::Alpha;

constexpr float kHalf = 0.5F;

Alpha alphaOf(const FramePlan& plan, const DrawItem& item) {
    Alpha alpha = Alpha::opaque;
    if (item.texture >= 0 && !plan.textureAlphas.empty())
        alpha = plan.textureAlphas[static_cast<std::size_t>(item.texture)];
    if (plan.style.layer != Layer::color)
        return alpha == Alpha::opaque ? Alpha::opaque : Alpha::cutOut;
    return item.opacity < 1.0F ? Alpha::blended : alpha;
}

/// The other side of an item.
DrawItem innerOf(const DrawItem& item) {
    DrawItem inner = item;
    inner.isInner = true;
    inner.inside = !item.inside;
    inner.mirrored = !item.mirrored;
    inner.normalFromObject = -item.normalFromObject;
    return inner;
}

/// Least and greatest distance along the view: of the vertices of a mesh's part, else of its box.
std::pair<float, float> depthsOf(const DrawItem& item) {
    std::pair<float, float> range(std::numeric_limits<float>::max(),
                                  std::numeric_limits<float>::lowest());
    const auto add = [&](const glm::vec3& position) {
        const float depth = -(item.viewFromObject * glm::vec4(position, 1.0F)).z;
        range.first = std::min(range.first, depth);
        range.second = std::max(range.second, depth);
    };
    const generator::Mesh& mesh = item.mesh->mesh;
    if (item.indices < mesh.indices().size() && item.mesh->eyePositions.empty()) {
        for (std::size_t i = item.firstIndex; i < item.firstIndex + item.indices; ++i)
            add(mesh.positions()[mesh.indices()[i]]);
        return range;
    }
    const Box& box = item.mesh->bounds;
    for (int i = 0; i < 8; ++i) add(glm::vec3(box.corner(i)));
    return range;
}

float sortDepth(const DrawItem& item) {
    const auto [nearest, farthest] = depthsOf(item);
    const float middle = 0.5F * (nearest + farthest);
    if (!item.isBody) return middle;
    return 0.5F * (middle + (item.inside ? farthest : nearest));
}

void sortBlended(std::vector<DrawItem>::iterator first, std::vector<DrawItem>::iterator last) {
    std::vector<std::pair<float, DrawItem>> sorted;
    // Backwards, so that of equal ones the first comes last.
    while (last != first) {
        --last;
        sorted.emplace_back(sortDepth(*last), std::move(*last));
    }
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    for (auto& [depth, item] : sorted) *first++ = std::move(item);
}

}  // namespace

bool isFlat(const Box& box) {
    const glm::dvec3 size = box.max - box.min;
    return std::min({size.x, size.y, size.z}) <= 1e-6 * std::max({size.x, size.y, size.z});
}

std::size_t arrangeSeeThrough(FramePlan& plan) {
    std::vector<DrawItem>& items = plan.items;
    std::erase_if(items, [](const DrawItem& item) { return item.isInner; });
    const bool layer = plan.style.layer != Layer::color;
    if (layer) std::erase_if(items, [](const DrawItem& item) { return item.opacity < kHalf; });
    bool any = false;
    plan.stats.cutOut = plan.stats.blended = 0;
    for (DrawItem& item : items) {
        item.alpha = alphaOf(plan, item);
        if (layer && item.alpha == Alpha::opaque && !plan.textureAlphas.empty()) item.texture = -1;
        any |= item.alpha != Alpha::opaque;
        plan.stats.cutOut += item.alpha == Alpha::cutOut ? 1 : 0;
        plan.stats.blended += item.alpha == Alpha::blended ? 1 : 0;
    }
    if (!any) return items.size();
    std::vector<DrawItem> all;
    all.reserve(2 * items.size());
    for (DrawItem& item : items) {
        const bool hasInner = item.alpha != Alpha::opaque && item.isBody;
        // Behind its outer side: blended ones are sorted from their end.
        DrawItem inner = hasInner ? innerOf(item) : DrawItem{};
        all.push_back(std::move(item));
        if (hasInner) all.push_back(std::move(inner));
    }
    items = std::move(all);
    const auto blended =
        std::stable_partition(items.begin(), items.end(),
                              [](const DrawItem& item) { return item.alpha != Alpha::blended; });
    sortBlended(blended, items.end());
    return static_cast<std::size_t>(blended - items.begin());
}

}  // namespace farol::render
