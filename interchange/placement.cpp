#include "interchange/placement.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/animation.h"

namespace farol::interchange {
namespace {

const glm::dquat kNoTurn(1.0, 0.0, 0.0, 0.0);

/// The turn about an axis; none about a zero axis.
glm::dquat turn(const glm::dvec3& axis, double angleDeg) {
    const double length = glm::length(axis);
    if (!(length > 0.0)) return kNoTurn;
    const double half = std::fmod(angleDeg, 720.0) * (std::numbers::pi / 360.0);
    return {std::cos(half), axis / length * std::sin(half)};
}

glm::dquat turnOf(const glm::dmat4& matrix) {
    return glm::normalize(glm::quat_cast(glm::dmat3(matrix)));
}

/// Collects transforms in a chain of nodes.
class Chain {
  public:
    explicit Chain(double timeS) : timeS_(timeS) {}

    void operator()(const scene::Translate& t) {
        // T R S T' is T'' R S.
        if (moves()) add();
        last().translation += last().rotation * (last().scale * t.offset);
    }
    void operator()(const scene::Rotate& t) {
        if (moves() || last().scale != glm::dvec3(1.0)) add();
        last().rotation = glm::normalize(last().rotation * turn(t.axis, t.angleDeg));
    }
    void operator()(const scene::Scale& t) { last().scale *= t.factors; }
    void operator()(const scene::Spin& t) {
        if (moves() || last().scale != glm::dvec3(1.0) || last().rotation != kNoTurn) add();
        last().spin = &t;
        last().rotation = turnOf(scene::matrixAt(scene::Transform(t), timeS_));
    }
    void operator()(const scene::FollowCurve& t) {
        if (!last().isIdentity()) add();
        last().curve = &t;
        const glm::dmat4 matrix = scene::matrixAt(scene::Transform(t), timeS_);
        last().translation = glm::dvec3(matrix[3]);
        last().rotation = turnOf(matrix);
    }
    std::vector<Placement> take() { return std::move(nodes_); }

  private:
    Placement& last() { return nodes_.back(); }
    bool moves() { return last().curve != nullptr || last().spin != nullptr; }
    void add() { nodes_.emplace_back(); }

    double timeS_;
    std::vector<Placement> nodes_{1};
};

/// Samples of a curve between two of its points, so that straight lines between them err by at
/// most kCurveError: the sagitta of a step h is at most h^2 / 8 of the second derivative, which is
/// linear between two points.
int stepsOf(const std::vector<glm::dvec3>& points) {
    glm::dvec3 low = points.front(), high = low;
    for (const glm::dvec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    const double error = kCurveError * glm::length(high - low);
    if (!(error > 0.0)) return 1;
    const std::size_t n = points.size();
    double bend = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec3 &a = points[(i + n - 1) % n], &b = points[i], &c = points[(i + 1) % n],
                         &d = points[(i + 2) % n];
        const glm::dvec3 k2 = a - 2.5 * b + 2.0 * c - 0.5 * d;
        const glm::dvec3 k3 = 1.5 * (b - c) + 0.5 * (d - a);
        bend = std::max({bend, glm::length(2.0 * k2), glm::length(2.0 * k2 + 6.0 * k3)});
    }
    return std::clamp(static_cast<int>(std::ceil(std::sqrt(bend / (8.0 * error)))), 1,
                      kMaxCurveSteps);
}

/// An aligned curve turns between its samples.
int stepsOf(const scene::FollowCurve& curve) {
    constexpr int kAligned = 16;
    const int steps = stepsOf(curve.points);
    return curve.align ? std::max(steps, kAligned) : steps;
}

double samplePeriod(const Placement& node) {
    if (node.curve != nullptr)
        return node.curve->seconds / static_cast<double>(node.curve->points.size()) /
               stepsOf(*node.curve);
    return std::abs(node.spin->seconds) / 4.0;
}

/// Values of a curve at the samples of one lap.
class Lap {
  public:
    Lap(const scene::FollowCurve& curve, int steps) : curve_(curve) {
        const std::size_t count = curve.points.size() * static_cast<std::size_t>(steps);
        for (std::size_t i = 0; i < count; ++i)
            matrices_.push_back(
                at(curve.seconds * static_cast<double>(i) / static_cast<double>(count)));
    }
    glm::dmat4 at(double timeS) const { return scene::matrixAt(scene::Transform(curve_), timeS); }
    const glm::dmat4& sampled(std::int64_t index) const {
        const auto count = static_cast<std::int64_t>(matrices_.size());
        return matrices_[static_cast<std::size_t>(((index % count) + count) % count)];
    }

  private:
    const scene::FollowCurve& curve_;
    std::vector<glm::dmat4> matrices_;
};

/// Calls `add(timeS, index)` at both ends of the span, with index -1, and at the multiples of
/// `period` between them.
template <typename Add>
void walk(double beginS, double durationS, double period, const Add& add) {
    add(beginS, std::int64_t{-1});
    for (auto i = static_cast<std::int64_t>(std::floor(beginS / period)) + 1;
         static_cast<double>(i) * period < beginS + durationS; ++i)
        add(static_cast<double>(i) * period, i);
    add(beginS + durationS, std::int64_t{-1});
}

}  // namespace

bool Placement::isIdentity() const {
    return translation == glm::dvec3(0.0) && rotation == kNoTurn && scale == glm::dvec3(1.0) &&
           curve == nullptr && spin == nullptr;
}

std::vector<Placement> placementsOf(const std::vector<scene::Transform>& transforms, double timeS) {
    Chain chain(timeS);
    for (const scene::Transform& transform : transforms) std::visit(chain, transform);
    return chain.take();
}

std::size_t countSamples(const Placement& node, double durationS) {
    if (node.curve == nullptr && node.spin == nullptr) return 0;
    return static_cast<std::size_t>(std::min(durationS / samplePeriod(node), 1e9)) + 2;
}

Motion sample(const Placement& node, double beginS, double durationS) {
    Motion motion;
    // Two times that are equal as floats would be one.
    const auto addTime = [&](double timeS) {
        const double since = timeS - beginS;
        if (!motion.timesS.empty() &&
            static_cast<float>(since) <= static_cast<float>(motion.timesS.back()))
            return false;
        motion.timesS.push_back(since);
        return true;
    };
    if (node.spin != nullptr) {
        walk(beginS, durationS, samplePeriod(node), [&](double timeS, std::int64_t) {
            if (!addTime(timeS)) return;
            motion.rotations.push_back(turn(node.spin->axis, 360.0 * timeS / node.spin->seconds));
        });
    } else if (node.curve != nullptr) {
        const Lap lap(*node.curve, stepsOf(*node.curve));
        walk(beginS, durationS, samplePeriod(node), [&](double timeS, std::int64_t index) {
            if (!addTime(timeS)) return;
            const glm::dmat4 matrix = index < 0 ? lap.at(timeS) : lap.sampled(index);
            motion.translations.emplace_back(matrix[3]);
            if (!node.curve->align) return;
            glm::dquat next = turnOf(matrix);
            // Of the two quaternions of a rotation, the one nearer to the last.
            if (!motion.rotations.empty() && glm::dot(motion.rotations.back(), next) < 0.0)
                next = -next;
            motion.rotations.push_back(next);
        });
    }
    return motion;
}

glm::dquat facing(const glm::dvec3& direction) {
    const double length = glm::length(direction);
    if (!(length > 0.0)) return kNoTurn;
    const glm::dvec3 from(0.0, 0.0, -1.0), to = direction / length;
    const double cosine = glm::dot(from, to);
    if (cosine < -1.0 + 1e-12) return {0.0, 0.0, 1.0, 0.0};  // half a turn about Y
    return glm::normalize(glm::dquat(1.0 + cosine, glm::cross(from, to)));
}

}  // namespace farol::interchange
