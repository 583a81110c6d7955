#include "grade/structure/slips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace farol::grade {
namespace {

using scene::FollowCurve;
using scene::Rotate;
using scene::Scale;
using scene::Spin;
using scene::Transform;
using scene::Translate;

constexpr double kClose = 0.012;  // of the larger: three digits of people's numbers

bool isNear(double a, double b, double scale) { return std::abs(a - b) <= kClose * scale; }

bool isNear(const glm::dvec3& a, const glm::dvec3& b) {
    const double scale = std::max({glm::length(a), glm::length(b), 1e-9});
    return glm::length(a - b) <= kClose * scale;
}

double reduced(double angle) {
    double out = std::fmod(angle, 360.0);
    if (out > 180.0) out -= 360.0;
    if (out <= -180.0) out += 360.0;
    return out;
}

bool sameAngle(double a, double b) { return std::abs(reduced(a - b)) < 0.35; }

glm::dvec3 unitOf(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0, 1, 0);
}

std::string joinedNames(const std::vector<int>& axes) {
    static constexpr std::array<char, 3> kNames{'x', 'y', 'z'};
    std::string out;
    for (std::size_t i = 0; i < axes.size(); ++i)
        out += std::string(i == 0                 ? ""
                           : i + 1 == axes.size() ? " and "
                                                  : ", ") +
               kNames[static_cast<std::size_t>(axes[i])];
    return out;
}

/// Vectors of a translate or a scale.
Slip slipOfVector(const glm::dvec3& mine, const glm::dvec3& goal, const std::string& word) {
    Slip out;
    const auto values = [&](const glm::dvec3& right) {
        return "is " + shortNumbers(mine) + ", expected " + shortNumbers(right);
    };
    const double scale = std::max({glm::length(mine), glm::length(goal), 1e-9});
    std::vector<int> turned, other;
    for (int axis = 0; axis < 3; ++axis) {
        if (isNear(mine[axis], goal[axis], scale)) continue;
        if (isNear(-mine[axis], goal[axis], scale))
            turned.push_back(axis);
        else
            other.push_back(axis);
    }
    if (other.empty() && !turned.empty()) {
        glm::dvec3 right = mine;
        for (const int axis : turned) right[axis] = -right[axis];
        return {"transform.sign",
                joinedNames(turned) + " of the " + word +
                    (turned.size() > 1 ? " have the wrong sign" : " has the wrong sign"),
                values(right),
                word + " sign " + joinedNames(turned),
                0.9,
                word == "scale" ? Transform(Scale{right}) : Transform(Translate{right})};
    }
    const auto made = [&](const glm::dvec3& v) {
        return word == "scale" ? Transform(Scale{v}) : Transform(Translate{v});
    };
    for (const auto& order : {std::array{1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}}) {
        const glm::dvec3 right(mine[order[0]], mine[order[1]], mine[order[2]]);
        if (!isNear(right, goal) || isNear(right, mine)) continue;
        return {"transform.coordinates",
                "coordinates of the " + word + " are exchanged",
                values(right),
                word + " coordinates",
                1.0,
                made(right)};
    }
    for (const double factor : {10.0, 0.1, 100.0, 0.01})
        if (isNear(mine * factor, goal) && glm::length(mine) > 0.0)
            return {"transform.magnitude",
                    "the numbers of the " + word + " are " +
                        (factor < 1.0 ? "too large, " : "too small, ") +
                        (factor == 10.0 || factor == 0.1 ? "ten" : "a hundred") + " times",
                    values(mine * factor),
                    word + " magnitude",
                    0.95,
                    made(mine * factor)};
    if (word == "scale" && mine.x * mine.y * mine.z != 0.0 && isNear(1.0 / mine, goal))
        return {"transform.inverse",
                "the scale is the inverse of what it should be",
                values(1.0 / mine),
                "scale inverse",
                1.0,
                made(1.0 / mine)};
    glm::dvec3 right = goal;
    for (int axis = 0; axis < 3; ++axis)
        right[axis] = isNear(mine[axis], goal[axis], scale * 0.1) ? mine[axis] : tidy(goal[axis]);
    std::vector<int> apart = other;
    apart.insert(apart.end(), turned.begin(), turned.end());
    std::sort(apart.begin(), apart.end());
    std::string way;
    if (apart.size() == 1) {
        const double from = mine[apart[0]], to = goal[apart[0]];
        if (from * to < 0.0)
            way = ", with the sign";
        else
            way = std::abs(from) > std::abs(to) ? ": too large" : ": too small";
    }
    return {"transform.value",
            joinedNames(apart) + " of the " + word +
                (apart.size() > 1 ? " have another value" : " has another value") + way,
            values(right),
            word + " value " + shortNumbers(right),
            1.25,
            made(right)};
}

Slip slipOfRotation(const Rotate& mine, const Rotate& given) {
    Rotate goal = given;
    const glm::dvec3 axis = unitOf(mine.axis);
    if (glm::dot(unitOf(goal.axis), axis) < -0.999) {
        goal.axis = -goal.axis;
        goal.angleDeg = -goal.angleDeg;
    }
    const bool sameAxis = glm::dot(unitOf(goal.axis), axis) > 0.9998;
    const auto about = [](const Rotate& r) {
        return shortNumber(r.angleDeg) + " about " + shortNumbers(r.axis);
    };
    if (sameAxis) {
        const auto values = [&](double angle) {
            return "is " + shortNumber(mine.angleDeg) + ", expected " + shortNumber(angle);
        };
        if (sameAngle(-mine.angleDeg, goal.angleDeg))
            return {"transform.angle-sign",
                    "the angle of the rotate has the wrong sign",
                    values(-mine.angleDeg),
                    "angle sign",
                    0.85,
                    Rotate{-mine.angleDeg, mine.axis}};
        const double degrees = mine.angleDeg * 180.0 / std::numbers::pi;
        if (std::abs(degrees) > 1.0 && std::abs(mine.angleDeg) < 7.0 &&
            std::abs(reduced(degrees - goal.angleDeg)) < 0.02 * std::abs(degrees) + 0.3)
            return {"transform.radians",
                    "the angle of the rotate is in radians, not in degrees",
                    values(tidy(goal.angleDeg)),
                    "radians",
                    0.8,
                    Rotate{tidy(goal.angleDeg), mine.axis}};
        for (const double factor : {10.0, 0.1})
            if (std::abs(reduced(mine.angleDeg * factor - goal.angleDeg)) < 0.35 &&
                std::abs(mine.angleDeg) < 720.0)
                return {"transform.magnitude",
                        std::string("the angle of the rotate is ") +
                            (factor < 1.0 ? "ten times too large" : "ten times too small"),
                        values(mine.angleDeg * factor),
                        "angle magnitude",
                        0.95,
                        Rotate{mine.angleDeg * factor, mine.axis}};
        if (sameAngle(180.0 - mine.angleDeg, goal.angleDeg) ||
            sameAngle(90.0 - mine.angleDeg, goal.angleDeg))
            return {"transform.value",
                    "the angle of the rotate is measured from another direction",
                    values(tidy(goal.angleDeg)),
                    "angle from elsewhere",
                    1.15,
                    Rotate{tidy(goal.angleDeg), mine.axis}};
        return {"transform.value",
                std::string("the angle of the rotate has another value: too ") +
                    (std::abs(reduced(mine.angleDeg)) > std::abs(reduced(goal.angleDeg)) ? "large"
                                                                                         : "small"),
                values(tidy(goal.angleDeg)),
                "angle value " + shortNumber(tidy(goal.angleDeg)),
                1.2,
                Rotate{tidy(goal.angleDeg), mine.axis}};
    }
    glm::dvec3 turnAxis = goal.axis;
    double angle = goal.angleDeg;
    if (sameAngle(-angle, mine.angleDeg) && !sameAngle(angle, mine.angleDeg)) {
        turnAxis = -turnAxis;
        angle = -angle;
    }
    if (sameAngle(angle, mine.angleDeg)) {
        glm::dvec3 right = unitOf(turnAxis);
        for (int i = 0; i < 3; ++i) right[i] = tidy(right[i]);
        return {"transform.axis",
                "the rotate turns about the wrong axis",
                "is " + about(mine) + ", expected " + about({mine.angleDeg, right}),
                "rotate axis",
                0.95,
                Rotate{mine.angleDeg, right}};
    }
    return {"transform.value",
            "the rotate has another angle and another axis",
            "is " + about(mine) + ", expected " + about(goal),
            "rotate value",
            1.6,
            goal};
}

Slip slipOfSpin(const Spin& mine, const Spin& given) {
    Spin goal = given;
    if (glm::dot(unitOf(goal.axis), unitOf(mine.axis)) < -0.999) goal = {-goal.seconds, -goal.axis};
    if (glm::dot(unitOf(goal.axis), unitOf(mine.axis)) < 0.9998)
        return {"animation.axis",
                "the rotate over time turns about the wrong axis",
                "is about " + shortNumbers(mine.axis) + ", expected " + shortNumbers(given.axis),
                "spin axis",
                0.95,
                given};
    if (isNear(-mine.seconds, goal.seconds, std::abs(goal.seconds)))
        return {"animation.direction",
                "the rotate over time turns the other way",
                "",
                "spin direction",
                0.9,
                goal};
    return {
        "animation.time",
        std::string("the rotate over time is too ") +
            (std::abs(mine.seconds) > std::abs(goal.seconds) ? "slow" : "fast"),
        "takes " + shortNumber(mine.seconds) + " s, expected " + shortNumber(goal.seconds) + " s",
        "spin time",
        1.0,
        goal};
}

Slip slipOfCurve(const FollowCurve& mine, const FollowCurve& goal) {
    const bool sameTime = isNear(mine.seconds, goal.seconds, goal.seconds);
    const auto samePoints = [](const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
        if (a.size() != b.size()) return false;
        for (std::size_t i = 0; i < a.size(); ++i)
            if (glm::length(a[i] - b[i]) > 1e-3 * std::max(1.0, glm::length(b[i]))) return false;
        return true;
    };
    if (samePoints(mine.points, goal.points)) {
        if (!sameTime)
            return {"animation.time",
                    std::string("the translate along points is too ") +
                        (mine.seconds > goal.seconds ? "slow" : "fast"),
                    "takes " + shortNumber(mine.seconds) + " s, expected " +
                        shortNumber(goal.seconds) + " s",
                    "curve time",
                    1.0,
                    goal};
        return {"animation.align",
                mine.align ? "the object turns with its curve, and should not (align)"
                           : "the object does not turn with its curve (align)",
                "",
                "curve align",
                0.9,
                goal};
    }
    std::vector<glm::dvec3> back(mine.points.rbegin(), mine.points.rend());
    for (std::size_t i = 0; i < back.size(); ++i) {
        if (samePoints(back, goal.points))
            return {"animation.direction",
                    "the points of the curve run the other way",
                    "",
                    "curve direction",
                    0.95,
                    goal};
        std::rotate(back.begin(), back.begin() + 1, back.end());
    }
    if (mine.points.size() != goal.points.size())
        return {"animation.points",
                mine.points.size() < goal.points.size() ? "points of the curve are missing"
                                                        : "the curve has too many points",
                "has " + std::to_string(mine.points.size()) + ", expected " +
                    std::to_string(goal.points.size()),
                "curve points",
                1.0,
                goal};
    return {"animation.points", "points of the curve lie elsewhere", "", "curve points", 1.0, goal};
}

}  // namespace

Slip slipBetween(const Transform& mine, const Transform& goal, bool isExact) {
    Slip out;
    const double more = isExact ? -0.3 : 0.0;  // the form of the reference is likelier
    if (mine.index() == goal.index()) {
        if (const auto* t = std::get_if<Translate>(&mine))
            out = slipOfVector(t->offset, std::get<Translate>(goal).offset, "translate");
        else if (const auto* s = std::get_if<Scale>(&mine))
            out = slipOfVector(s->factors, std::get<Scale>(goal).factors, "scale");
        else if (const auto* r = std::get_if<Rotate>(&mine))
            out = slipOfRotation(*r, std::get<Rotate>(goal));
        else if (const auto* spin = std::get_if<Spin>(&mine))
            out = slipOfSpin(*spin, std::get<Spin>(goal));
        else
            out = slipOfCurve(std::get<FollowCurve>(mine), std::get<FollowCurve>(goal));
        if (isExact) out.right = goal;
        out.effort += more;
        return out;
    }
    const bool moves = goal.index() == 1 || goal.index() == 3;
    const bool moved = mine.index() == 1 || mine.index() == 3;
    out = {moves && !moved   ? "animation.missing"
           : moved && !moves ? "animation.extra"
                             : "transform.kind",
           "it is a " + wordOf(mine) + ", expected a " + wordOf(goal),
           "is " + textOf(mine) + ", expected " + textOf(goal),
           "kind " + wordOf(mine) + " " + wordOf(goal),
           1.3 + more,
           goal};
    return out;
}

bool isSameTransform(const Transform& a, const Transform& b) {
    if (a.index() != b.index()) return false;
    const auto close = [](const glm::dvec3& x, const glm::dvec3& y) {
        return glm::length(x - y) <= 1e-3 * std::max({glm::length(x), glm::length(y), 1e-6});
    };
    if (const auto* t = std::get_if<Translate>(&a))
        return close(t->offset, std::get<Translate>(b).offset);
    if (const auto* s = std::get_if<Scale>(&a))
        return close(s->factors, std::get<Scale>(b).factors);
    if (const auto* r = std::get_if<Rotate>(&a)) {
        const auto& other = std::get<Rotate>(b);
        const double turn = glm::dot(unitOf(r->axis), unitOf(other.axis));
        return (turn > 0.99999 && std::abs(reduced(r->angleDeg - other.angleDeg)) < 0.02) ||
               (turn < -0.99999 && std::abs(reduced(r->angleDeg + other.angleDeg)) < 0.02);
    }
    if (const auto* spin = std::get_if<Spin>(&a)) {
        const auto& other = std::get<Spin>(b);
        const double turn = glm::dot(unitOf(spin->axis), unitOf(other.axis));
        return std::abs(turn) > 0.99999 &&
               std::abs(spin->seconds - (turn > 0 ? 1 : -1) * other.seconds) <
                   1e-3 * std::abs(other.seconds);
    }
    const auto &curve = std::get<FollowCurve>(a), &other = std::get<FollowCurve>(b);
    if (curve.align != other.align || curve.points.size() != other.points.size() ||
        std::abs(curve.seconds - other.seconds) > 1e-3 * other.seconds)
        return false;
    for (std::size_t i = 0; i < curve.points.size(); ++i)
        if (!close(curve.points[i], other.points[i])) return false;
    return true;
}

std::string wordOf(const Transform& transform) {
    constexpr std::array<const char*, 5> kWords{"translate", "translate along points", "rotate",
                                                "rotate over time", "scale"};
    return kWords[transform.index()];
}

std::string textOf(const Transform& transform) {
    struct Words {
        std::string operator()(const Translate& t) const {
            return "translate " + shortNumbers(t.offset);
        }
        std::string operator()(const FollowCurve& t) const {
            return "translate along " + std::to_string(t.points.size()) + " points in " +
                   shortNumber(t.seconds) + " s";
        }
        std::string operator()(const Rotate& t) const {
            return "rotate " + shortNumber(t.angleDeg) + " about " + shortNumbers(t.axis);
        }
        std::string operator()(const Spin& t) const {
            return "rotate in " + shortNumber(t.seconds) + " s about " + shortNumbers(t.axis);
        }
        std::string operator()(const Scale& t) const { return "scale " + shortNumbers(t.factors); }
    };
    return std::visit(Words{}, transform);
}

double tidy(double value) {
    for (const double step : {1.0, 0.1, 0.01, 0.001}) {
        const double round = std::round(value / step) * step;
        if (std::abs(round - value) < 2e-4 * std::max(1.0, std::abs(value))) return round;
    }
    return value;
}

std::string shortNumber(double value) {
    char text[64];
    std::snprintf(text, sizeof text, "%.4f", value);
    std::string out = text;
    if (out.find('.') != std::string::npos) {
        out.erase(out.find_last_not_of('0') + 1);
        if (out.back() == '.') out.pop_back();
    }
    return out == "-0" ? "0" : out;
}

std::string shortNumbers(const glm::dvec3& vector) {
    return shortNumber(vector.x) + " " + shortNumber(vector.y) + " " + shortNumber(vector.z);
}

}  // namespace farol::grade
