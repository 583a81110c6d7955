#include "generator/io/polygon.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>

#include "generator/io/corner_tree.h"

namespace farol::generator::io {
namespace {

using Point = glm::dvec2;

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
/// corners that do not turn left can be in the way; they are kept in a tree, so that a face of
/// many corners does not take the square of their number.
class Clipper {
  public:
    Clipper(const std::vector<Point>& flat, std::vector<FaceTriangle>& out)
        : flat_(flat),
          out_(out),
          left_(flat.size()),
          previous_(left_),
          next_(left_),
          queued_(left_, false),
          gone_(left_, false),
          blocks_(left_) {
        for (std::size_t i = 0; i < left_; ++i) {
            previous_[i] = i == 0 ? left_ - 1 : i - 1;
            next_[i] = i + 1 == left_ ? 0 : i + 1;
        }
        for (std::size_t i = 0; i < left_; ++i) blocks_[i] = turnAt(i) <= 0;
        blockers_.emplace(flat_, blocks_);
    }

    void run() {
        // Repeated corners and needles go first: beside them, false ears pass the test. A simple
        // polygon then always has an ear of some area. A polygon that crosses or touches itself
        // may have none: then flat ears are clipped as well, and the rest becomes a fan.
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
        unblock(at);
        --left_;
        for (const std::size_t near : {before, after}) {
            if (turnAt(near) > 0) unblock(near);
            enqueue(near);
        }
    }

    void unblock(std::size_t at) {
        if (blocks_[at]) blockers_->remove(at);
        blocks_[at] = false;
    }

    bool isEar(std::size_t at) const {
        const Point &a = flat_[previous_[at]], &b = flat_[at], &c = flat_[next_[at]];
        if (a == b || b == c || c == a) return true;  // a repeated corner, the tip of a needle
        const double area = turn(a, b, c);
        if (ears_ == Ears::needles || area < 0 || (ears_ == Ears::proper && area == 0))
            return false;
        // Strictly inside a triangle without area there is nothing.
        if (area == 0) return true;
        // On the edge counts at first, so that no edge of a triangle passes through a corner.
        return !blockers_->anyIn({a, b, c, ears_ == Ears::proper});
    }

    const std::vector<Point>& flat_;
    std::vector<FaceTriangle>& out_;
    std::size_t left_;
    std::vector<std::size_t> previous_, next_;
    std::vector<bool> queued_, gone_, blocks_;
    std::optional<CornerTree> blockers_;  ///< the corners of blocks_
    std::deque<std::size_t> queue_;
    Ears ears_ = Ears::needles;
};

}  // namespace

void triangulate(const std::vector<glm::vec3>& corners, std::vector<FaceTriangle>& out) {
    out.clear();
    const std::vector<Point> flat = corners.size() > 3 ? flatten(corners) : std::vector<Point>();
    if (!flat.empty() && !fanCovers(flat)) return Clipper(flat, out).run();
    for (std::uint32_t k = 2; k < corners.size(); ++k) out.push_back({0, k - 1, k});
}

void triangulate(const std::vector<glm::dvec3>& corners, std::vector<FaceTriangle>& out) {
    if (corners.size() == 3) {  // nothing to choose
        out.assign(1, {0, 1, 2});
        return;
    }
    constexpr double kFar = 1024.0;  // sizes of the face
    glm::dvec3 reach(0.0);
    for (const glm::dvec3& corner : corners) reach = glm::max(reach, glm::abs(corner - corners[0]));
    const glm::dvec3 size = glm::abs(corners[0]);
    const bool far =
        std::max({size.x, size.y, size.z}) > kFar * std::max({reach.x, reach.y, reach.z});
    const glm::dvec3 origin = far ? corners[0] : glm::dvec3(0.0);
    std::vector<glm::vec3> near;
    near.reserve(corners.size());
    for (const glm::dvec3& corner : corners) near.emplace_back(corner - origin);
    triangulate(near, out);
}

}  // namespace farol::generator::io
