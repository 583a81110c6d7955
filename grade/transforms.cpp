#include "grade/transforms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "scene/animation.h"

namespace farol::grade {
namespace {

using scene::FollowCurve;
using scene::Rotate;
using scene::Scale;
using scene::Spin;
using scene::Transform;
using scene::Translate;

constexpr std::size_t kMostSteps = 64;  // deeper chains are compared as matrices only

const char* wordOf(const Transform& transform) {
    constexpr std::array<const char*, 5> kWords{"translate", "translate along points", "rotate",
                                                "rotate over time", "scale"};
    return kWords[transform.index()];
}

std::string text(const glm::dvec3& v) {
    return shortNumber(v.x) + " " + shortNumber(v.y) + " " + shortNumber(v.z);
}

/// Its numbers, for messages.
std::string describe(const Transform& transform) {
    struct Words {
        std::string operator()(const Translate& t) const { return "translate " + text(t.offset); }
        std::string operator()(const FollowCurve& t) const {
            return "translate along " + std::to_string(t.points.size()) + " points in " +
                   shortNumber(t.seconds) + " s";
        }
        std::string operator()(const Rotate& t) const {
            return "rotate " + shortNumber(t.angleDeg) + " about " + text(t.axis);
        }
        std::string operator()(const Spin& t) const {
            return "rotate in " + shortNumber(t.seconds) + " s about " + text(t.axis);
        }
        std::string operator()(const Scale& t) const { return "scale " + text(t.factors); }
    };
    return std::visit(Words{}, transform);
}

struct Change {
    std::string code, message;
    Location where;
    std::vector<Transform> chain;
};

class Explainer {
  public:
    Explainer(const Piece& reference, const Piece& submission, double sceneSize,
              const glm::dvec2& times)
        : theirs_(reference.steps),
          mine_(submission.steps),
          bounds_(reference.mesh->bounds),
          sceneSize_(sceneSize),
          times_(times),
          group_(submission.group) {
        for (const Step& step : theirs_) goal_.push_back(*step.transform);
        for (const Step& step : mine_) chain_.push_back(*step.transform);
    }

    Findings run() {
        if (goal_.size() > kMostSteps || chain_.size() > kMostSteps) return unexplained();
        for (const auto& attempt :
             {&Explainer::exchange, &Explainer::alter, &Explainer::take, &Explainer::leaveOut,
              &Explainer::insert, &Explainer::reorder, &Explainer::takeSeveral})
            if ((this->*attempt)())
                return {{found_.code, Topic::transforms, found_.message, found_.where}};
        return unexplained();
    }

  private:
    std::string group(const Step& step) const { return "group " + std::to_string(step.group); }

    bool reaches(const std::vector<Transform>& chain) const {
        for (const double time : {times_.x, times_.y})
            if (!samePlace(scene::matrixAt(chain, time), scene::matrixAt(goal_, time), bounds_,
                           sceneSize_))
                return false;
        return true;
    }
    bool settle(const std::vector<Transform>& chain, const std::string& code,
                const std::string& message, const Location& where) {
        if (!reaches(chain)) return false;
        found_ = {code, message + inLine(where), where, {}};
        return true;
    }

    bool exchange() {
        for (std::size_t near = 0; near < 2; ++near)  // within one group first
            for (std::size_t i = 0; i < chain_.size(); ++i)
                for (std::size_t j = i + 1; j < chain_.size(); ++j) {
                    if ((mine_[i].group != mine_[j].group) != (near == 1)) continue;
                    std::vector<Transform> chain = chain_;
                    std::swap(chain[i], chain[j]);
                    const std::string first = wordOf(chain_[i]), second = wordOf(chain_[j]);
                    const std::string what = near == 0
                                                 ? group(mine_[i]) + ": " + first + " and " + second
                                                 : first + " of " + group(mine_[i]) + " and " +
                                                       second + " of " + group(mine_[j]);
                    if (settle(chain, "transform.order", what + " are swapped", mine_[i].where))
                        return true;
                }
        return false;
    }

    bool alterRotation(std::size_t i, const Rotate& mine) {
        std::vector<Transform> chain = chain_;
        const std::string prefix = group(mine_[i]) + ": the angle of rotate ";
        const auto with = [&](double angle) {
            chain[i] = Rotate{angle, mine.axis};
            return chain;
        };
        const std::string given = shortNumber(mine.angleDeg);
        if (settle(with(-mine.angleDeg), "transform.angle-sign",
                   prefix + "has the wrong sign: " + given + ", expected " +
                       shortNumber(-mine.angleDeg),
                   mine_[i].where))
            return true;
        const double degrees = mine.angleDeg * 180.0 / std::numbers::pi;
        for (const double angle : {degrees, nearest(degrees, mine.axis)})
            if (settle(with(angle), "transform.radians",
                       prefix + "looks like radians: " + given + ", expected " +
                           shortNumber(angle) + " degrees",
                       mine_[i].where))
                return true;
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 other(0.0);
            other[axis] = 1.0;
            chain[i] = Rotate{mine.angleDeg, other};
            if (settle(chain, "transform.axis",
                       group(mine_[i]) + ": rotate turns about " + text(mine.axis) + ", expected " +
                           text(other),
                       mine_[i].where))
                return true;
        }
        return false;
    }

    /// The reference's own angle, if it is the degrees but for the rounding of radians.
    double nearest(double degrees, const glm::dvec3& axis) const {
        for (const Transform& goal : goal_)
            if (const auto* rotate = std::get_if<Rotate>(&goal))
                if (std::abs(rotate->angleDeg - degrees) < 0.02 * std::abs(degrees) + 0.3 &&
                    glm::length(glm::cross(rotate->axis, axis)) < 1e-6)
                    return rotate->angleDeg;
        return degrees;
    }

    bool alterVector(std::size_t i, const glm::dvec3& mine, const std::string& word,
                     const std::function<Transform(const glm::dvec3&)>& made) {
        std::vector<Transform> chain = chain_;
        static constexpr std::array<char, 3> kNames{'x', 'y', 'z'};
        for (int bits = 1; bits < 8; ++bits) {
            glm::dvec3 other = mine;
            std::string names;
            for (int axis = 0; axis < 3; ++axis)
                if ((bits & (1 << axis)) != 0) {
                    other[axis] = -other[axis];
                    if (mine[axis] != 0.0)
                        names += std::string(names.empty() ? "" : " and ") +
                                 kNames[static_cast<std::size_t>(axis)];
                }
            chain[i] = made(other);
            if (settle(chain, "transform.sign",
                       group(mine_[i]) + ": " + names + " of " + word +
                           " has the wrong sign: " + text(mine) + ", expected " + text(other),
                       mine_[i].where))
                return true;
        }
        for (const auto& order :
             {std::array{1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}}) {
            const glm::dvec3 other(mine[order[0]], mine[order[1]], mine[order[2]]);
            chain[i] = made(other);
            if (settle(chain, "transform.coordinates",
                       group(mine_[i]) + ": the coordinates of " + word +
                           " are swapped: " + text(mine) + ", expected " + text(other),
                       mine_[i].where))
                return true;
        }
        return false;
    }

    bool alter() {
        for (std::size_t i = 0; i < chain_.size(); ++i) {
            if (const auto* rotate = std::get_if<Rotate>(&chain_[i])) {
                if (alterRotation(i, *rotate)) return true;
            } else if (const auto* spin = std::get_if<Spin>(&chain_[i])) {
                std::vector<Transform> chain = chain_;
                chain[i] = Spin{-spin->seconds, spin->axis};
                if (settle(chain, "transform.angle-sign",
                           group(mine_[i]) + ": rotate over time turns the other way",
                           mine_[i].where))
                    return true;
            } else if (const auto* translate = std::get_if<Translate>(&chain_[i])) {
                if (alterVector(i, translate->offset, "translate",
                                [](const glm::dvec3& v) { return Translate{v}; }))
                    return true;
            } else if (const auto* scale = std::get_if<Scale>(&chain_[i])) {
                if (alterVector(i, scale->factors, "scale",
                                [](const glm::dvec3& v) { return Scale{v}; }))
                    return true;
            }
        }
        return false;
    }

    /// One transform of the submission becomes one of the reference's.
    bool take() {
        for (std::size_t i = 0; i < chain_.size(); ++i)
            for (const Transform& goal : goal_) {
                std::vector<Transform> chain = chain_;
                chain[i] = goal;
                const bool alike = goal.index() == chain_[i].index();
                if (settle(chain, alike ? "transform.value" : "transform.kind",
                           group(mine_[i]) + ": " + describe(chain_[i]) + ", expected " +
                               describe(goal),
                           mine_[i].where))
                    return true;
            }
        return false;
    }

    bool leaveOut() {
        for (std::size_t i = 0; i < chain_.size(); ++i) {
            std::vector<Transform> chain = chain_;
            chain.erase(chain.begin() + static_cast<std::ptrdiff_t>(i));
            if (settle(chain, "transform.extra",
                       group(mine_[i]) + ": " + describe(chain_[i]) + " is too much",
                       mine_[i].where))
                return true;
        }
        return false;
    }

    bool insert() {
        for (std::size_t i = 0; i <= chain_.size(); ++i)
            for (const Transform& goal : goal_) {
                std::vector<Transform> chain = chain_;
                chain.insert(chain.begin() + static_cast<std::ptrdiff_t>(i), goal);
                const int at = i < mine_.size() ? mine_[i].group
                               : i > 0          ? mine_[i - 1].group
                                                : group_;
                const Location where = i < mine_.size() ? mine_[i].where
                                       : i > 0          ? mine_[i - 1].where
                                                        : Location{};
                if (settle(chain, "transform.missing",
                           "group " + std::to_string(at) + ": " + describe(goal) + " is missing",
                           where))
                    return true;
            }
        return false;
    }

    /// Another order of one group's transforms.
    bool reorder() {
        for (std::size_t begin = 0; begin < chain_.size();) {
            std::size_t end = begin;
            while (end < chain_.size() && mine_[end].group == mine_[begin].group) ++end;
            std::vector<std::size_t> order;
            for (std::size_t i = begin; i < end; ++i) order.push_back(i);
            const bool few = order.size() >= 3 && order.size() <= 5;
            while (few && std::next_permutation(order.begin(), order.end())) {
                std::vector<Transform> chain = chain_;
                for (std::size_t i = begin; i < end; ++i) chain[i] = chain_[order[i - begin]];
                if (settle(chain, "transform.order",
                           group(mine_[begin]) + ": the transforms are in the wrong order",
                           mine_[begin].where))
                    return true;
            }
            begin = end;
        }
        return false;
    }

    /// Lists of the same kinds of transforms: all numbers that differ.
    bool takeSeveral() {
        if (goal_.size() != chain_.size()) return false;
        std::string message;
        Location where;
        for (std::size_t i = 0; i < goal_.size(); ++i) {
            if (goal_[i].index() != chain_[i].index()) return false;
            const std::string mine = describe(chain_[i]), theirs = describe(goal_[i]);
            if (mine == theirs) continue;
            if (where.line == 0) where = mine_[i].where;
            message +=
                (message.empty() ? group(mine_[i]) + ": " : "; ") + mine + ", expected " + theirs;
        }
        return !message.empty() && settle(goal_, "transform.value", message, where);
    }

    Findings unexplained() const {
        const Location where = mine_.empty() ? Location{} : mine_.back().where;
        return {{"transform.other", Topic::transforms,
                 "group " + std::to_string(group_) + ": the transforms lead to another place" +
                     inLine(where),
                 where}};
    }

    const std::vector<Step>& theirs_;
    const std::vector<Step>& mine_;
    const render::Box& bounds_;
    double sceneSize_;
    glm::dvec2 times_;
    int group_;
    std::vector<Transform> goal_, chain_;
    Change found_;
};

}  // namespace

bool samePlace(const glm::dmat4& a, const glm::dmat4& b, const render::Box& bounds,
               double sceneSize) {
    constexpr double kOfScene = 1e-3;
    const render::Box box = bounds.empty() ? render::Box{glm::dvec3(-1), glm::dvec3(1)} : bounds;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                           corner & 4 ? box.max.z : box.min.z, 1.0);
        if (glm::length(glm::dvec3(a * p - b * p)) > kOfScene * sceneSize) return false;
    }
    return true;
}

Findings explainPlace(const Piece& reference, const Piece& submission, double sceneSize,
                      const glm::dvec2& times) {
    return Explainer(reference, submission, sceneSize, times).run();
}

}  // namespace farol::grade
