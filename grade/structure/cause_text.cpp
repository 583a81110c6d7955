#include "grade/structure/cause_text.h"

#include <cstdio>
#include <span>
#include <variant>

#include "core/text.h"
#include "grade/structure/messages.h"

namespace farol::grade {

using scene::FollowCurve;
using scene::Rotate;
using scene::Scale;
using scene::Spin;
using scene::Transform;
using scene::Translate;

Message elementOf(const Transform& transform) {
    switch (transform.index()) {
        case 0:
            return causeMessage<"part.element/translate">();
        case 1:
            return causeMessage<"part.element/curve">();
        case 2:
            return causeMessage<"part.element/rotate">();
        case 3:
            return causeMessage<"part.element/spin">();
        default:
            return causeMessage<"part.element/scale">();
    }
}

Message textOf(const Transform& transform) {
    struct Words {
        Message operator()(const Translate& t) const {
            return causeMessage<"part.transform/translate">("offset"_arg = shortNumbers(t.offset));
        }
        Message operator()(const FollowCurve& t) const {
            return causeMessage<"part.transform/curve">("count"_arg = t.points.size(),
                                                        "seconds"_arg = shortNumber(t.seconds));
        }
        Message operator()(const Rotate& t) const {
            return causeMessage<"part.transform/rotate">("angle"_arg = shortNumber(t.angleDeg),
                                                         "axis"_arg = shortNumbers(t.axis));
        }
        Message operator()(const Spin& t) const {
            return causeMessage<"part.transform/spin">("seconds"_arg = shortNumber(t.seconds),
                                                       "axis"_arg = shortNumbers(t.axis));
        }
        Message operator()(const Scale& t) const {
            return causeMessage<"part.transform/scale">("factors"_arg = shortNumbers(t.factors));
        }
    };
    return std::visit(Words{}, transform);
}

Message listOf(const std::vector<std::string>& words) {
    if (words.size() < 2)
        return causeMessage<"part.list/one">("item"_arg = words.empty() ? "" : words.front());
    return causeMessage<"part.list/and">(
        "list"_arg = uncut(joined(std::span(words).first(words.size() - 1), ", ")),
        "last"_arg = words.back());
}

Message twoValues(const std::string& mine, const std::string& right) {
    return causeMessage<"part.values/two">("value"_arg = uncut(mine),
                                           "expected"_arg = uncut(right));
}

Message twoValues(double mine, double right) {
    return twoValues(shortNumber(mine), shortNumber(right));
}

Message twoValues(const glm::dvec3& mine, const glm::dvec3& right) {
    return twoValues(shortNumbers(mine), shortNumbers(right));
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

std::string levels(const scene::Color& color) {
    return shortNumbers(glm::round(glm::dvec3(color.rgb) * 25500.0) / 100.0);
}

}  // namespace farol::grade
