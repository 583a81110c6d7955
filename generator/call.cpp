#include "generator/call.h"

#include <cmath>

#include "core/did_you_mean.h"
#include "core/number.h"
#include "core/text.h"
#include "generator/registry.h"
#include "generator/words.h"

namespace farol::generator {
namespace {

using Form = scene::ShapeArgument::Form;

/// What the user wrote, quoted and of bounded length.
std::string quoted(const std::string& word) {
    constexpr std::size_t kShown = 40;
    return "\"" + (word.size() > kShown ? word.substr(0, kShown) + "..." : word) + "\"";
}

[[noreturn]] void refuse(const ShapeEntry& shape, const std::string& what) {
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

double readValue(const ShapeEntry& shape, const Argument& argument, const std::string& word) {
    const std::string kind = argument.isInteger() ? "a whole number" : "a number";
    double value = 0;
    if (!parseNumber(word, value) || value < argument.min || value > argument.max ||
        (argument.isInteger() && value != std::floor(value)))
        refuse(shape, "the argument " + argument.name + " of " + shape.name + " must be " + kind +
                          " from " + formatNumber(argument.min) + " to " +
                          formatNumber(argument.max) + ", not " + quoted(word) + pointFor(word));
    return value;
}

[[noreturn]] void unknown(const std::string& word) {
    std::vector<std::string> names;
    for (const ShapeEntry& shape : shapes()) names.push_back(shape.name);
    const std::string near = didYouMean(word, names);
    throw Error("shape.unknown", "there is no shape " + quoted(word) +
                                     (near.empty() ? "; there are " + joined(names, ", ")
                                                   : "; did you mean \"" + near + "\"?"));
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

ShapeCall parseCall(const std::vector<std::string>& words, std::vector<std::string>* notes) {
    if (words.empty()) throw Error("shape.unknown", "no shape is named");
    const ShapeEntry* entry = findShape(words[0]);
    if (entry == nullptr) unknown(words[0]);
    ShapeCall call;
    call.entry = entry;
    std::size_t at = 1;
    if (entry->takesFile) {
        if (words.size() < 2) refuse(*entry, entry->name + " needs a file");
        call.file = words[at++];
    }
    const std::vector<Argument>& arguments = entry->arguments;
    std::size_t count = words.size() - at;
    if (count > arguments.size() && notes != nullptr) {
        notes->push_back(quoted(joined(words, " ")) + " has " + std::to_string(count) +
                         " numbers; using the first " + std::to_string(arguments.size()) + " (" +
                         usageOf(*entry) + ")");
        count = arguments.size();
    }
    if (count > arguments.size())
        refuse(*entry, entry->name + " takes at most " + std::to_string(arguments.size()) +
                           " numbers, not " + std::to_string(count));
    if (count < entry->required)
        refuse(*entry,
               "the argument " + arguments[count].name + " of " + entry->name + " is missing");
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
        notes->push_back(quoted(joined(words, " ")) + " has " + arguments[1].name + " before " +
                         arguments[0].name + "; using " + quoted(textOf(call)));
    }
    const std::string fault = entry->check != nullptr ? entry->check(call) : "";
    if (!fault.empty()) refuse(*entry, fault);
    return call;
}

}  // namespace farol::generator
