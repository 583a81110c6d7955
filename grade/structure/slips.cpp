#include "grade/structure/slips.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/text.h"
#include "grade/structure/messages.h"

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

std::vector<std::string> namesOf(const std::vector<int>& axes) {
    std::vector<std::string> names;
    for (const int axis : axes) names.emplace_back(1, static_cast<char>('x' + axis));
    return names;
}

Message twoTransforms(const Transform& mine, const Transform& right) {
    return causeMessage<"part.values/two">("value"_arg = textOf(mine),
                                           "expected"_arg = textOf(right));
}

/// A finding without arguments.
template <FixedString kId>
CauseWords plain(const Message& values = {}) {
    return {causeMessage<kId>(), values};
}

/// The values of one axis or several; `axes` is not empty.
CauseWords wordsOfValue(const glm::dvec3& mine, const glm::dvec3& goal, const glm::dvec3& right,
                        const std::vector<int>& axes, const std::string& element) {
    const Message values = twoValues(mine, right);
    if (axes.size() > 1)
        return {causeMessage<"part.finding/values">("axes"_arg = listOf(namesOf(axes)),
                                                    "element"_arg = element),
                values};
    const std::string axis = namesOf(axes).front();
    const double from = mine[axes.front()], to = goal[axes.front()];
    if (from * to < 0.0)
        return {causeMessage<"part.finding/value-sign">("axis"_arg = axis, "element"_arg = element),
                values};
    if (std::abs(from) > std::abs(to))
        return {
            causeMessage<"part.finding/value-large">("axis"_arg = axis, "element"_arg = element),
            values};
    return {causeMessage<"part.finding/value-small">("axis"_arg = axis, "element"_arg = element),
            values};
}

}  // namespace

Slip slipOfVector(const glm::dvec3& mine, const glm::dvec3& goal, const std::string& element) {
    const auto made = [&](const glm::dvec3& v) {
        return element == "scale" ? Transform(Scale{v}) : Transform(Translate{v});
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
        std::string kind = element + " sign";
        for (const int axis : turned) {
            right[axis] = -right[axis];
            kind += " " + std::to_string(axis);
        }
        return {"transform.sign",
                [=]() -> CauseWords {
                    const Message values = twoValues(mine, right);
                    if (turned.size() > 1)
                        return {causeMessage<"part.finding/signs">(
                                    "axes"_arg = listOf(namesOf(turned)), "element"_arg = element),
                                values};
                    return {causeMessage<"part.finding/sign">("axis"_arg = namesOf(turned).front(),
                                                              "element"_arg = element),
                            values};
                },
                kind, 0.9, made(right)};
    }
    for (const auto& order : {std::array{1, 0, 2}, {0, 2, 1}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}}) {
        const glm::dvec3 right(mine[order[0]], mine[order[1]], mine[order[2]]);
        if (!isNear(right, goal) || isNear(right, mine)) continue;
        return {"transform.coordinates",
                [=]() -> CauseWords {
                    return {causeMessage<"part.finding/coordinates">("element"_arg = element),
                            twoValues(mine, right)};
                },
                element + " coordinates", 1.0, made(right)};
    }
    for (const double factor : {10.0, 0.1, 100.0, 0.01})
        if (isNear(mine * factor, goal) && glm::length(mine) > 0.0)
            return {"transform.magnitude",
                    [=]() -> CauseWords {
                        const int times = factor == 10.0 || factor == 0.1 ? 10 : 100;
                        const Message values = twoValues(mine, mine * factor);
                        if (factor < 1.0)
                            return {causeMessage<"part.finding/numbers-large">(
                                        "element"_arg = element, "factor"_arg = times),
                                    values};
                        return {causeMessage<"part.finding/numbers-small">("element"_arg = element,
                                                                           "factor"_arg = times),
                                values};
                    },
                    element + " magnitude", 0.95, made(mine * factor)};
    if (element == "scale" && mine.x * mine.y * mine.z != 0.0 && isNear(1.0 / mine, goal))
        return {"transform.inverse",
                [=] { return plain<"part.finding/inverse">(twoValues(mine, 1.0 / mine)); },
                "scale inverse", 1.0, made(1.0 / mine)};
    glm::dvec3 right = goal;
    for (int axis = 0; axis < 3; ++axis)
        right[axis] = isNear(mine[axis], goal[axis], scale * 0.1) ? mine[axis] : tidy(goal[axis]);
    std::vector<int> apart = other;
    apart.insert(apart.end(), turned.begin(), turned.end());
    std::sort(apart.begin(), apart.end());
    if (apart.empty()) {  // all within rounding: the one that is farthest off
        const glm::dvec3 off = glm::abs(mine - goal);
        apart.push_back(off.x >= off.y && off.x >= off.z ? 0 : off.y >= off.z ? 1 : 2);
    }
    return {"transform.value", [=] { return wordsOfValue(mine, goal, right, apart, element); },
            element + " value " + shortNumbers(right), 1.25, made(right)};
}

namespace {

Slip slipOfAngle(const Rotate& mine, const Rotate& goal) {
    using Words = CauseWords (*)(const Message&);
    const auto slip = [&](const char* code, Words words, const std::string& kind, double effort,
                          double right) -> Slip {
        return {code, [=, is = mine.angleDeg] { return words(twoValues(is, right)); }, kind, effort,
                Rotate{right, mine.axis}};
    };
    if (sameAngle(-mine.angleDeg, goal.angleDeg))
        return slip("transform.angle-sign", plain<"part.finding/angle-sign">, "angle sign", 0.85,
                    -mine.angleDeg);
    const double degrees = mine.angleDeg * 180.0 / std::numbers::pi;
    const double right = tidy(goal.angleDeg);
    if (std::abs(degrees) > 1.0 && std::abs(mine.angleDeg) < 7.0 &&
        std::abs(reduced(degrees - goal.angleDeg)) < 0.02 * std::abs(degrees) + 0.3)
        return slip("transform.radians", plain<"part.finding/angle-radians">, "radians", 0.8,
                    right);
    for (const double factor : {10.0, 0.1})
        if (std::abs(reduced(mine.angleDeg * factor - goal.angleDeg)) < 0.35 &&
            std::abs(mine.angleDeg) < 720.0)
            return slip("transform.magnitude",
                        factor < 1.0 ? plain<"part.finding/angle-ten-large">
                                     : plain<"part.finding/angle-ten-small">,
                        "angle magnitude", 0.95, mine.angleDeg * factor);
    if (sameAngle(180.0 - mine.angleDeg, goal.angleDeg) ||
        sameAngle(90.0 - mine.angleDeg, goal.angleDeg))
        return slip("transform.value", plain<"part.finding/angle-origin">, "angle from elsewhere",
                    1.15, right);
    const bool isLarge = std::abs(reduced(mine.angleDeg)) > std::abs(reduced(goal.angleDeg));
    return slip("transform.value",
                isLarge ? plain<"part.finding/angle-large"> : plain<"part.finding/angle-small">,
                "angle value " + shortNumber(right), 1.2, right);
}

Slip slipOfRotation(const Rotate& mine, const Rotate& given) {
    Rotate goal = given;
    const glm::dvec3 axis = unitOf(mine.axis);
    if (glm::dot(unitOf(goal.axis), axis) < -0.999) {
        goal.axis = -goal.axis;
        goal.angleDeg = -goal.angleDeg;
    }
    if (glm::dot(unitOf(goal.axis), axis) > 0.9998) return slipOfAngle(mine, goal);
    glm::dvec3 turnAxis = goal.axis;
    double angle = goal.angleDeg;
    if (sameAngle(-angle, mine.angleDeg) && !sameAngle(angle, mine.angleDeg)) {
        turnAxis = -turnAxis;
        angle = -angle;
    }
    if (sameAngle(angle, mine.angleDeg)) {
        glm::dvec3 right = unitOf(turnAxis);
        for (int i = 0; i < 3; ++i) right[i] = tidy(right[i]);
        const Rotate turned{mine.angleDeg, right};
        return {"transform.axis",
                [=] { return plain<"part.finding/axis">(twoTransforms(mine, turned)); },
                "rotate axis", 0.95, turned};
    }
    return {"transform.value",
            [=] { return plain<"part.finding/angle-axis">(twoTransforms(mine, goal)); },
            "rotate value", 1.6, goal};
}

Message twoTimes(double mine, double right) {
    return causeMessage<"part.values/seconds">("value"_arg = shortNumber(mine),
                                               "expected"_arg = shortNumber(right));
}

Slip slipOfSpin(const Spin& mine, const Spin& given) {
    Spin goal = given;
    if (glm::dot(unitOf(goal.axis), unitOf(mine.axis)) < -0.999) goal = {-goal.seconds, -goal.axis};
    if (glm::dot(unitOf(goal.axis), unitOf(mine.axis)) < 0.9998)
        return {"animation.axis",
                [=] { return plain<"part.finding/spin-axis">(twoTransforms(mine, given)); },
                "spin axis", 0.95, given};
    if (isNear(-mine.seconds, goal.seconds, std::abs(goal.seconds)))
        return {"animation.direction", [] { return plain<"part.finding/spin-direction">(); },
                "spin direction", 0.9, goal};
    return {"animation.time",
            [=] {
                const Message values = twoTimes(mine.seconds, goal.seconds);
                return std::abs(mine.seconds) > std::abs(goal.seconds)
                           ? plain<"part.finding/spin-slow">(values)
                           : plain<"part.finding/spin-fast">(values);
            },
            "spin time", 1.0, goal};
}

Slip slipOfCurve(const FollowCurve& mine, const FollowCurve& goal) {
    const auto samePoints = [](const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
        if (a.size() != b.size()) return false;
        for (std::size_t i = 0; i < a.size(); ++i)
            if (glm::length(a[i] - b[i]) > 1e-3 * std::max(1.0, glm::length(b[i]))) return false;
        return true;
    };
    if (samePoints(mine.points, goal.points)) {
        const double from = mine.seconds, to = goal.seconds;
        if (!isNear(from, to, to))
            return {"animation.time",
                    [=] {
                        return from > to ? plain<"part.finding/curve-slow">(twoTimes(from, to))
                                         : plain<"part.finding/curve-fast">(twoTimes(from, to));
                    },
                    "curve time", 1.0, goal};
        return {"animation.align",
                [aligned = mine.align] {
                    return aligned ? plain<"part.finding/align-extra">()
                                   : plain<"part.finding/align">();
                },
                "curve align", 0.9, goal};
    }
    std::vector<glm::dvec3> back(mine.points.rbegin(), mine.points.rend());
    for (std::size_t i = 0; i < back.size(); ++i) {
        if (samePoints(back, goal.points))
            return {"animation.direction", [] { return plain<"part.finding/curve-direction">(); },
                    "curve direction", 0.95, goal};
        std::rotate(back.begin(), back.begin() + 1, back.end());
    }
    const std::size_t from = mine.points.size(), to = goal.points.size();
    if (from == to)
        return {"animation.points", [] { return plain<"part.finding/points">(); }, "curve points",
                1.0, goal};
    return {"animation.points",
            [=] {
                const Message values =
                    causeMessage<"part.values/count">("value"_arg = from, "expected"_arg = to);
                return from < to ? plain<"part.finding/points-missing">(values)
                                 : plain<"part.finding/points-extra">(values);
            },
            "curve points", 1.0, goal};
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
           [mine, goal]() -> CauseWords {
               return {causeMessage<"part.finding/element">("value"_arg = elementOf(mine),
                                                            "expected"_arg = elementOf(goal)),
                       twoTransforms(mine, goal)};
           },
           "kind " + std::to_string(mine.index()) + " " + std::to_string(goal.index()), 1.3 + more,
           goal};
    return out;
}

Slip slipOfExtra(const Transform& extra, double effort) {
    return {"transform.extra",
            [extra]() -> CauseWords {
                return {
                    causeMessage<"part.finding/element-extra">("element"_arg = elementOf(extra)),
                    causeMessage<"part.values/is">("value"_arg = textOf(extra))};
            },
            "extra " + std::to_string(extra.index()),
            effort,
            {}};
}

Slip slipOfMissing(const Transform& missing, double effort) {
    const bool moves = missing.index() == 1 || missing.index() == 3;
    return {moves ? "animation.missing" : "transform.missing",
            [missing]() -> CauseWords {
                return {causeMessage<"part.finding/element-missing">("element"_arg =
                                                                         elementOf(missing)),
                        causeMessage<"part.values/expected">("expected"_arg = textOf(missing))};
            },
            "missing " + std::to_string(missing.index()),
            effort,
            {}};
}

Slip slipOfOrder(const Transform& first, const Transform& second, double effort) {
    return {"transform.order",
            [first, second]() -> CauseWords {
                return {causeMessage<"part.finding/order-two">("first"_arg = elementOf(first),
                                                               "second"_arg = elementOf(second)),
                        {}};
            },
            "order " + std::to_string(first.index()) + " " + std::to_string(second.index()),
            effort,
            {}};
}

Slip slipOfWhole(const Transform& needed) {
    const char* const code = needed.index() == 0   ? "whole.moved"
                             : needed.index() == 2 ? "whole.turned"
                                                   : "whole.scaled";
    return {code,
            [needed]() -> CauseWords {
                const Message values =
                    causeMessage<"part.values/needs">("transforms"_arg = textOf(needed));
                if (needed.index() == 0)
                    return {causeMessage<"part.finding/whole-moved">(), values};
                if (needed.index() == 2)
                    return {causeMessage<"part.finding/whole-turned">(), values};
                return {causeMessage<"part.finding/whole-scaled">(), values};
            },
            code,
            1.2,
            {}};
}

Slip slipOfPlace(bool isWhole, const std::vector<Transform>& parts, double effort) {
    return {isWhole ? "whole.moved" : "transform.other",
            [isWhole, parts]() -> CauseWords {
                const std::string all =
                    joined(parts, ", ", [](const auto& part) { return textOf(part).text; });
                if (isWhole)
                    return {causeMessage<"part.finding/whole-place">(),
                            causeMessage<"part.values/needs">("transforms"_arg = uncut(all))};
                return {causeMessage<"part.finding/place">(),
                        parts.empty()
                            ? Message()
                            : causeMessage<"part.values/expected">("expected"_arg = uncut(all))};
            },
            isWhole ? "whole.moved" : "place",
            effort,
            {}};
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

double tidy(double value) {
    for (const double step : {1.0, 0.1, 0.01, 0.001}) {
        const double round = std::round(value / step) * step;
        if (std::abs(round - value) < 2e-4 * std::max(1.0, std::abs(value))) return round;
    }
    return value;
}

}  // namespace farol::grade
