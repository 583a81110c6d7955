#include "generator/io/corner_tree.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>

namespace farol::generator::io {
namespace {

using Point = glm::dvec2;

/// Returns the largest turn(a, b, p) over the points p of the box. Rounding is monotonic: a point
/// computed to be inside is never in a box computed to be outside.
double mostTurn(const Point& a, const Point& b, const Point& low, const Point& high) {
    return turn(a, b, {b.y >= a.y ? low.x : high.x, b.x >= a.x ? high.y : low.y});
}

bool isLess(const Point& a, const Point& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

}  // namespace

bool EarTriangle::contains(const Point& p) const {
    if (p == a || p == b || p == c) return false;
    const double least = std::min({turn(a, b, p), turn(b, c, p), turn(c, a, p)});
    return closed ? least >= 0 : least > 0;
}

bool EarTriangle::meets(const Point& low, const Point& high) const {
    const Point first = glm::min(glm::min(a, b), c), last = glm::max(glm::max(a, b), c);
    if (first.x > high.x || last.x < low.x || first.y > high.y || last.y < low.y) return false;
    const double least =
        std::min({mostTurn(a, b, low, high), mostTurn(b, c, low, high), mostTurn(c, a, low, high)});
    return closed ? least >= 0 : least > 0;
}

CornerTree::CornerTree(const std::vector<Point>& corners, const std::vector<bool>& included)
    : placeOf_(corners.size()) {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < corners.size(); ++i)
        if (included[i]) order.push_back(i);
    if (order.empty()) return;
    std::sort(order.begin(), order.end(), [&corners](std::uint32_t i, std::uint32_t k) {
        return isLess(corners[i], corners[k]);
    });
    std::vector<std::uint32_t> firstOf;  // the place of each corner, before the tree orders them
    for (const std::uint32_t i : order) {
        if (places_.empty() || places_.back().at != corners[i])
            places_.push_back({corners[i], 0, 0});
        ++places_.back().corners;
        firstOf.push_back(static_cast<std::uint32_t>(places_.size() - 1));
    }
    // The leaf's number marks where a place came from until the tree is built.
    for (std::uint32_t i = 0; i < places_.size(); ++i) places_[i].leaf = i;
    build(0, static_cast<std::uint32_t>(places_.size()), 0);
    std::vector<std::uint32_t> now(places_.size());
    for (std::uint32_t i = 0; i < places_.size(); ++i) now[places_[i].leaf] = i;
    for (std::size_t k = 0; k < order.size(); ++k) placeOf_[order[k]] = now[firstOf[k]];
    for (std::uint32_t n = 0; n < nodes_.size(); ++n)
        if (nodes_[n].second == 0)
            for (std::uint32_t i = nodes_[n].begin; i < nodes_[n].end; ++i) places_[i].leaf = n;
}

std::uint32_t CornerTree::build(std::uint32_t begin, std::uint32_t end, std::uint32_t parent) {
    constexpr std::uint32_t kLeaf = 8;  // places
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    Node node{places_[begin].at, places_[begin].at, begin, end, 0, parent, 0};
    for (std::uint32_t i = begin; i < end; ++i) {
        node.low = glm::min(node.low, places_[i].at);
        node.high = glm::max(node.high, places_[i].at);
        node.corners += places_[i].corners;
    }
    nodes_.push_back(node);
    if (end - begin <= kLeaf) return number;
    const int axis = node.high.x - node.low.x >= node.high.y - node.low.y ? 0 : 1;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(places_.begin() + begin, places_.begin() + middle, places_.begin() + end,
                     [axis](const Place& p, const Place& q) { return p.at[axis] < q.at[axis]; });
    build(begin, middle, number);
    nodes_[number].second = build(middle, end, number);
    return number;
}

void CornerTree::remove(std::size_t corner) {
    Place& place = places_[placeOf_[corner]];
    --place.corners;
    std::uint32_t node = place.leaf;
    for (; node != 0; node = nodes_[node].parent) --nodes_[node].corners;
    --nodes_[0].corners;
}

bool CornerTree::anyIn(const EarTriangle& triangle, std::uint32_t number) const {
    const Node& node = nodes_[number];
    if (node.corners == 0 || !triangle.meets(node.low, node.high)) return false;
    if (node.second != 0) return anyIn(triangle, number + 1) || anyIn(triangle, node.second);
    return std::any_of(places_.begin() + node.begin, places_.begin() + node.end,
                       [&triangle](const Place& place) {
                           return place.corners > 0 && triangle.contains(place.at);
                       });
}

}  // namespace farol::generator::io
