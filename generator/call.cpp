#include "generator/call.h"

#include <cmath>

#include "core/did_you_mean.h"
#include "core/number.h"
#include "core/text.h"
#include "generator/messages.h"
#include "generator/registry.h"
#include "generator/words.h"

namespace farol::generator {
namespace {

using Form = scene::ShapeArgument::Form;

/// Returns the word with a point for its comma if that is a number; else "".
std::string withPoint(std::string word) {
    const std::size_t comma = word.find(',');
    if (comma == std::string::npos) return "";
    word[comma] = '.';
    double value = 0;
    return parseNumber(word, value) ? word : "";
}

double readValue(const ShapeEntry& shape, const Argument& argument, const std::string& word) {
    double value = 0;
    if (!parseNumber(word, value) || value < argument.min || value > argument.max ||
        (argument.isInteger() && value != std::floor(value))) {
        const auto name = "argument"_arg = argument.name;
        const auto of = "shape"_arg = shape.name;
        const auto found = "value"_arg = word;
        const auto min = "min"_arg = argument.min;
        const auto max = "max"_arg = argument.max;
        const auto point = "suggestion"_arg = withPoint(word);
        const auto usage = "usage"_arg = uncut(usageOf(shape));
        throw Error(
            argument.isInteger()
                ? message<"shape.argument/whole">(name, of, found, min, max, point, usage)
                : message<"shape.argument/number">(name, of, found, min, max, point, usage));
    }
    return value;
}

std::vector<std::string> shapeNames() {
    std::vector<std::string> names;
    for (const ShapeEntry& shape : shapes()) names.push_back(shape.name);
    return names;
}

[[noreturn]] void unknown(const std::string& word) {
    const std::vector<std::string> names = shapeNames();
    const std::string near = didYouMean(word, names);
    if (near.empty())
        throw Error(message<"shape.unknown/list">("word"_arg = word,
                                                  "shapes"_arg = uncut(joined(names, ", "))));
    throw Error(message<"shape.unknown/near">("word"_arg = word, "suggestion"_arg = near));
}

}  // namespace

std::string usageOf(const ShapeEntry& shape) {
    if (!shape.usage.empty()) return shape.usage;
    std::string text = shape.name + (shape.takesFile ? " FILE" : "");
    for (std::size_t i = 0; i < shape.arguments.size(); ++i) {
        const std::string& name = shape.arguments[i].name;
        text += i < shape.required ? " " + name : " [" + name + "]";
    }
    return text;
}

std::string textOf(const ShapeCall& call) {
    std::string text = call.entry->name;
    if (call.entry->takesFile)
        text += isOneWord(call.file) ? " " + call.file : " \"" + call.file + '"';
    for (const scene::ShapeArgument& argument : call.arguments) {
        if (argument.form == Form::automatic) text += " auto";
        if (argument.form == Form::written) text += " " + formatNumber(argument.value);
    }
    return text;
}

bool parseNumber(const std::string& word, double& value) {
    std::string_view digits = word;
    if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
    if (digits.size() > 1 && lowerCase(digits.back()) == 'f') digits.remove_suffix(1);
    const auto number = parseExact<double>(digits);
    value = number.value_or(value);
    return number.has_value();
}

ShapeCall parseCall(const std::vector<std::string>& words, std::vector<Message>* notes) {
    if (words.empty())
        throw Error(
            message<"shape.unknown/empty">("shapes"_arg = uncut(joined(shapeNames(), ", "))));
    const ShapeEntry* entry = findShape(words[0]);
    if (entry == nullptr) unknown(words[0]);
    const auto usage = "usage"_arg = uncut(usageOf(*entry));
    const auto shape = "shape"_arg = entry->name;
    ShapeCall call;
    call.entry = entry;
    std::size_t at = 1;
    if (entry->takesFile) {
        if (words.size() < 2) throw Error(message<"shape.argument/file">(shape, usage));
        call.file = words[at++];
    }
    const std::vector<Argument>& arguments = entry->arguments;
    std::size_t count = words.size() - at;
    if (count > arguments.size() && notes != nullptr) {
        notes->push_back(message<"shape.argument/surplus">("call"_arg = joined(words, " "),
                                                           "count"_arg = count,
                                                           "most"_arg = arguments.size(), usage));
        count = arguments.size();
    }
    if (count > arguments.size())
        throw Error(message<"shape.argument/count">(shape, "count"_arg = count,
                                                    "most"_arg = arguments.size(), usage));
    if (count < entry->required)
        throw Error(message<"shape.argument/missing">("argument"_arg = arguments[count].name, shape,
                                                      usage));
    for (const Argument& argument : arguments)
        call.arguments.push_back({Form::omitted, argument.fallback});
    for (std::size_t i = 0; i < count; ++i) {
        const std::string& word = words[at + i];
        const std::size_t meant = i + 1 == count ? arguments[i].whenLast.value_or(i) : i;
        if (word == "auto" && arguments[meant].isLevel())
            call.arguments[meant].form = Form::automatic;
        else
            call.arguments[meant] = {Form::written, readValue(*entry, arguments[meant], word)};
    }
    if (notes != nullptr && entry->isExchanged != nullptr && entry->isExchanged(call)) {
        std::swap(call.arguments[0], call.arguments[1]);
        notes->push_back(message<"shape.argument/exchanged">(
            "call"_arg = joined(words, " "), "second"_arg = arguments[1].name,
            "first"_arg = arguments[0].name, "used"_arg = textOf(call)));
    }
    const Message problem = entry->check != nullptr ? entry->check(call) : Message();
    if (!problem.empty())
        throw Error(message<"shape.argument/together">("problem"_arg = problem, usage));
    return call;
}

}  // namespace farol::generator
