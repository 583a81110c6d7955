#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/plan/frustum.h"

namespace farol::render {

/// Boxes in a binary tree by place, so that whole groups outside a view or within it are found
/// with one test.
class BoundsTree {
  public:
    BoundsTree() = default;
    /// Empty boxes are left out: they are never found. O(n log n).
    explicit BoundsTree(std::span<const Box> boxes);

    struct Found {
        /// A Frustum::Side for every box: outside where its group or it itself is.
        std::vector<Frustum::Side> sides;
        int groupsSkipped = 0;  ///< groups of several boxes found outside by one test
        int tests = 0;          ///< boxes of groups and single ones that were tried
    };
    Found find(const Frustum& frustum) const;

  private:
    struct Node {
        Box bounds;
        std::uint32_t begin = 0, end = 0;  ///< of order_
        std::uint32_t right = 0;           ///< the left child follows its parent; 0: a leaf
    };
    std::uint32_t build(std::uint32_t begin, std::uint32_t end, int depth);
    void visit(std::uint32_t node, const Frustum& frustum, unsigned planes, Found& found) const;

    std::vector<Node> nodes_;
    std::vector<std::uint32_t> order_;
    std::vector<Box> boxes_;
};

}  // namespace farol::render
