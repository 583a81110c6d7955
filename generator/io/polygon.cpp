#include "generator/io/polygon.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace farol::generator::io {
namespace {

using Point = glm::dvec2;

/// Twice the area of a, b, c: positive where they turn left, 0 where they lie in one line.
/// Differences of floats are exact in double unless they are of very different size.
double turn(const Point& a, const Point& b, const Point& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The face seen along the axis that its area is largest for, turning left; empty without area.
/// Leaving a coordinate out, instead of turning the plane, keeps straight lines straight.
std::vector<Point> flatten(const std::vector<glm::vec3>& corners) {
    glm::dvec3 area(0);
    const glm::dvec3 first(corners[0]);
    for (std::size_t k = 2; k < corners.size(); ++k)
        area += glm::cross(glm::dvec3(corners[k - 1]) - first, glm::dvec3(corners[k]) - first);
    const glm::dvec3 size = glm::abs(area);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (size[axis] == 0.0) return {};
    const int a = (axis + (area[axis] > 0 ? 1 : 2)) % 3, b = 3 - axis - a;
    std::vector<Point> flat;
    flat.reserve(corners.size());
    for (const glm::vec3& corner : corners) flat.emplace_back(corner[a], corner[b]);
    return flat;
}

bool fanCovers(const std::vector<Point>& flat) {
    for (std::size_t k = 2; k < flat.size(); ++k)
        if (turn(flat[0], flat[k - 1], flat[k]) <= 0) return false;
    return true;
}

/// Cuts off one ear after the other: a corner whose triangle holds none of the others. Only
/// corners that do not turn left can be in the way; they are kept in a grid, so that a face of
/// many corners does not take the square of their number.
class Clipper {
  public:
    Clipper(const std::vector<Point>& flat, std::vector<FaceTriangle>& out)
        : flat_(flat),
          out_(out),
          left_(flat.size()),
          previous_(left_),
          next_(left_),
          blocks_(left_),
          queued_(left_, false),
          gone_(left_, false) {
        for (std::size_t i = 0; i < left_; ++i) {
            previous_[i] = i == 0 ? left_ - 1 : i - 1;
            next_[i] = i + 1 == left_ ? 0 : i + 1;
        }
        for (std::size_t i = 0; i < left_; ++i) blocks_[i] = turnAt(i) <= 0;
        fillGrid();
    }

    void run() {
        // Repeated corners and needles go first: beside them other ears look right that are not.
        // A simple polygon then always has an ear of some area. What crosses or touches itself
        // may not: flat ears are cut as well, and in the end whatever is left is fanned.
        for (const Ears ears : {Ears::needles, Ears::proper, Ears::any}) {
            ears_ = ears;
            for (std::size_t i = 0; i < flat_.size(); ++i) enqueue(i);
            clipQueued();
        }
        const std::size_t first =
            static_cast<std::size_t>(std::find(gone_.begin(), gone_.end(), false) - gone_.begin());
        for (std::size_t at = next_[first]; next_[at] != first; at = next_[at])
            emit(first, at, next_[at]);
    }

  private:
    enum class Ears { needles, proper, any };

    double turnAt(std::size_t i) const {
        return turn(flat_[previous_[i]], flat_[i], flat_[next_[i]]);
    }

    void emit(std::size_t a, std::size_t b, std::size_t c) {
        out_.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                        static_cast<std::uint32_t>(c)});
    }

    void enqueue(std::size_t i) {
        if (gone_[i] || queued_[i]) return;
        queued_[i] = true;
        queue_.push_back(i);
    }

    void clipQueued() {
        while (left_ > 3 && !queue_.empty()) {
            const std::size_t at = queue_.front();
            queue_.pop_front();
            queued_[at] = false;
            if (!gone_[at] && isEar(at)) clip(at);
        }
    }

    void clip(std::size_t at) {
        const std::size_t before = previous_[at], after = next_[at];
        emit(before, at, after);
        next_[before] = after;
        previous_[after] = before;
        gone_[at] = true;
        blocks_[at] = false;
        --left_;
        for (const std::size_t near : {before, after}) {
            blocks_[near] = blocks_[near] && turnAt(near) <= 0;
            enqueue(near);
        }
    }

    bool isEar(std::size_t at) const {
        const Point &a = flat_[previous_[at]], &b = flat_[at], &c = flat_[next_[at]];
        if (a == b || b == c || c == a) return true;  // a repeated corner, the tip of a needle
        const double area = turn(a, b, c);
        if (ears_ == Ears::needles || area < 0 || (ears_ == Ears::proper && area == 0))
            return false;
        const auto [x0, x1] = std::minmax({a.x, b.x, c.x});
        const auto [y0, y1] = std::minmax({a.y, b.y, c.y});
        if (heads_.empty()) return true;
        const std::size_t column0 = cellOf(x0, low_.x, cell_.x),
                          column1 = cellOf(x1, low_.x, cell_.x);
        const std::size_t row0 = cellOf(y0, low_.y, cell_.y), row1 = cellOf(y1, low_.y, cell_.y);
        for (std::size_t row = row0; row <= row1; ++row)
            for (std::size_t column = column0; column <= column1; ++column)
                for (std::size_t i = heads_[row * side_ + column]; i != kNone; i = chain_[i])
                    if (blocks_[i] && inTheWay(flat_[i], a, b, c)) return false;
        return true;
    }

    /// On the edge counts, so that no edge of a triangle passes through a corner. The same place
    /// as a corner does not: faces with holes go through some corners twice.
    bool inTheWay(const Point& p, const Point& a, const Point& b, const Point& c) const {
        if (p == a || p == b || p == c) return false;
        const double least = std::min({turn(a, b, p), turn(b, c, p), turn(c, a, p)});
        return ears_ == Ears::proper ? least >= 0 : least > 0;
    }

    void fillGrid() {
        const auto count =
            static_cast<std::size_t>(std::count(blocks_.begin(), blocks_.end(), true));
        if (count == 0) return;
        constexpr std::size_t kMostCells = 1024;
        side_ = std::min(
            kMostCells, static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count)))));
        Point high = low_ = flat_[0];
        for (const Point& p : flat_) {
            low_ = glm::min(low_, p);
            high = glm::max(high, p);
        }
        cell_ = (high - low_) / static_cast<double>(side_);
        heads_.assign(side_ * side_, kNone);
        chain_.assign(flat_.size(), kNone);
        for (std::size_t i = 0; i < flat_.size(); ++i) {
            if (!blocks_[i]) continue;
            std::size_t& head = heads_[cellOf(flat_[i].y, low_.y, cell_.y) * side_ +
                                       cellOf(flat_[i].x, low_.x, cell_.x)];
            chain_[i] = head;
            head = i;
        }
    }

    std::size_t cellOf(double at, double low, double cell) const {
        return std::min(side_ - 1, static_cast<std::size_t>((at - low) / cell));
    }

    static constexpr std::size_t kNone = ~std::size_t{0};

    const std::vector<Point>& flat_;
    std::vector<FaceTriangle>& out_;
    std::size_t left_;
    std::vector<std::size_t> previous_, next_;
    std::vector<bool> blocks_, queued_, gone_;
    std::deque<std::size_t> queue_;
    Ears ears_ = Ears::needles;
    std::size_t side_ = 0;
    Point low_{0}, cell_{0};
    std::vector<std::size_t> heads_, chain_;
};

}  // namespace

void triangulate(const std::vector<glm::vec3>& corners, std::vector<FaceTriangle>& out) {
    out.clear();
    const std::vector<Point> flat = corners.size() > 3 ? flatten(corners) : std::vector<Point>();
    if (!flat.empty() && !fanCovers(flat)) return Clipper(flat, out).run();
    for (std::uint32_t k = 2; k < corners.size(); ++k) out.push_back({0, k - 1, k});
}

}  // namespace farol::generator::io
