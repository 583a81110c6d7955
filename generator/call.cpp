#include "generator/call.h"

#include <charconv>
#include <cmath>

#include "generator/entry.h"
#include "scene/text.h"

namespace farol::generator {
namespace {

std::string spell(double value) {
    char text[32];
    const bool plain = std::abs(value) <= 1e9 && value == std::floor(value);  // 100000, not 1e+05
    const auto end = plain ? std::to_chars(text, text + sizeof text, static_cast<long>(value)).ptr
                           : std::to_chars(text, text + sizeof text, value).ptr;
    return {text, end};
}

/// What the user wrote, quoted and of bounded length.
std::string quoted(const std::string& word) {
    constexpr std::size_t kShown = 40;
    return "\"" + (word.size() > kShown ? word.substr(0, kShown) + "..." : word) + "\"";
}

[[noreturn]] void refuse(const Shape& shape, const std::string& what) {
    throw Error("shape.argument", what + "; usage: " + usageOf(shape));
}

/// The cure for a decimal comma, where that is all that is wrong.
std::string pointFor(std::string word) {
    const std::size_t comma = word.find(',');
    if (comma == std::string::npos) return "";
    word[comma] = '.';
    double value = 0;
    return parseNumber(word, value) ? " (write " + quoted(word) + ")" : "";
}

double readValue(const Shape& shape, const Argument& argument, const std::string& word) {
    const std::string kind = argument.integer ? "a whole number" : "a number";
    double value = 0;
    if (!parseNumber(word, value) || value < argument.min || value > argument.max ||
        (argument.integer && value != std::floor(value)))
        refuse(shape, "the argument " + argument.name + " of " + shape.name + " must be " + kind +
                          " from " + spell(argument.min) + " to " + spell(argument.max) + ", not " +
                          quoted(word) + pointFor(word));
    return value;
}

}  // namespace

std::string usageOf(const Shape& shape) {
    if (!shape.form.empty()) return shape.form;
    std::string text = shape.name + (shape.takesFile ? " FILE" : "");
    for (std::size_t i = 0; i < shape.arguments.size(); ++i) {
        const std::string& name = shape.arguments[i].name;
        text += i < shape.required ? " " + name : " [" + name + "]";
    }
    return text;
}

bool parseNumber(const std::string& word, double& value) {
    const char* begin = word.data();
    const char* end = begin + word.size();
    if (end - begin > 1 && *begin == '+' && begin[1] != '-') ++begin;
    if (end - begin > 1 && (end[-1] == 'f' || end[-1] == 'F')) --end;
    const auto [stop, failed] = std::from_chars(begin, end, value);
    return failed == std::errc() && stop == end && begin != end && std::isfinite(value);
}

Call parseCall(const std::vector<std::string>& words) {
    if (words.empty()) throw Error("shape.unknown", "no shape is named");
    const Shape* shape = findShape(words[0]);
    if (shape == nullptr) {
        std::vector<std::string> names;
        for (const Shape& one : shapes()) names.push_back(one.name);
        const std::string near = scene::didYouMean(words[0], names);
        std::string all;
        for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
        throw Error("shape.unknown",
                    "there is no shape " + quoted(words[0]) +
                        (near.empty() ? "; there are " + all : "; did you mean \"" + near + "\"?"));
    }
    Call call;
    call.shape = shape;
    std::size_t at = 1;
    if (shape->takesFile) {
        if (words.size() < 2) refuse(*shape, shape->name + " needs a file");
        call.file = words[at++];
    }
    call.given = words.size() - at;
    if (call.given > shape->arguments.size())
        refuse(*shape, shape->name + " takes at most " + std::to_string(shape->arguments.size()) +
                           " numbers, not " + std::to_string(call.given));
    if (call.given < shape->required)
        refuse(*shape, "the argument " + shape->arguments[call.given].name + " of " + shape->name +
                           " is missing");
    for (const Argument& own : shape->arguments) {
        const bool written = at < words.size();
        const bool last = own.whenLast && call.values.size() + 1 == call.given;
        const Argument& argument = last ? shape->arguments[*own.whenLast] : own;
        const std::string word = written ? words[at++] : "";
        const bool automatic = word == "auto" && argument.level;
        call.values.push_back(written && !automatic ? readValue(*shape, argument, word)
                                                    : argument.fallback);
        if (automatic) call.given = std::min(call.given, call.values.size() - 1);
    }
    const auto check = entryOf(*shape).check;
    if (check != nullptr) {
        const std::string fault = check(call);
        if (!fault.empty()) refuse(*shape, fault);
    }
    return call;
}

}  // namespace farol::generator
