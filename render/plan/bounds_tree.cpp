#include "render/plan/bounds_tree.h"

#include <algorithm>

namespace farol::render {
namespace {

constexpr std::uint32_t kLeaf = 8;
constexpr int kMaxDepth = 48;  // halving 2^32 boxes takes 32

}  // namespace

BoundsTree::BoundsTree(std::span<const Box> boxes) : boxes_(boxes.begin(), boxes.end()) {
    for (std::uint32_t i = 0; i < boxes_.size(); ++i)
        if (!boxes_[i].empty()) order_.push_back(i);
    if (!order_.empty()) build(0, static_cast<std::uint32_t>(order_.size()), 0);
}

std::uint32_t BoundsTree::build(std::uint32_t begin, std::uint32_t end, int depth) {
    const auto self = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, begin, end, 0});
    Box bounds, centers;
    const auto center = [&](std::uint32_t i) { return boxes_[i].min + boxes_[i].max; };
    for (std::uint32_t i = begin; i < end; ++i) {
        bounds.add(boxes_[order_[i]].min);
        bounds.add(boxes_[order_[i]].max);
        centers.add(center(order_[i]));
    }
    nodes_[self].bounds = bounds;
    if (end - begin <= kLeaf || depth >= kMaxDepth) return self;
    const glm::dvec3 size = centers.max - centers.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(
        order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
        [&](std::uint32_t a, std::uint32_t b) {
            return center(a)[axis] != center(b)[axis] ? center(a)[axis] < center(b)[axis] : a < b;
        });
    build(begin, middle, depth + 1);
    const std::uint32_t right = build(middle, end, depth + 1);
    nodes_[self].right = right;
    return self;
}

BoundsTree::Found BoundsTree::find(const Frustum& frustum) const {
    Found found;
    found.sides.assign(boxes_.size(), Frustum::Side::outside);
    if (!nodes_.empty()) visit(0, frustum, Frustum::kAllPlanes, found);
    return found;
}

void BoundsTree::visit(std::uint32_t index, const Frustum& frustum, unsigned planes,
                       Found& found) const {
    const Node& node = nodes_[index];
    ++found.tests;
    const Frustum::Side side = frustum.test(node.bounds, planes);
    if (side == Frustum::Side::outside) {
        if (node.end - node.begin > 1) ++found.groupsSkipped;
        return;
    }
    if (side == Frustum::Side::straddles && node.right != 0) {
        visit(index + 1, frustum, planes, found);
        visit(node.right, frustum, planes, found);
        return;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
        const std::uint32_t box = order_[i];
        if (side == Frustum::Side::straddles && node.end - node.begin > 1) {
            unsigned left = planes;
            ++found.tests;
            found.sides[box] = frustum.test(boxes_[box], left);
        } else {
            found.sides[box] = side;
        }
    }
}

}  // namespace farol::render
