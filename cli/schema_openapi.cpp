#include <cctype>
#include <charconv>

#include "cli/schema.h"
#include "core/text.h"
#include "grade/rubric/metrics.h"
#include "image/animation.h"
#include "image/format.h"
#include "render/options.h"

namespace farol::cli {
namespace {

/// Double quotes of JSON are double quotes of YAML.
std::string yamlText(const std::string& text) { return nlohmann::json(text).dump(); }

std::string listOf(const std::vector<std::string>& words) {
    return "[" + joined(words, ", ") + "]";
}

/// Words of which YAML 1.1 reads some (on, off) as booleans.
std::string listOfWords(std::vector<std::string> words) {
    for (std::string& word : words)
        if (word == "on" || word == "off") word = "'" + word + "'";
    return listOf(words);
}

std::string schemaOf(const render::OptionSpec& option) {
    using render::OptionType;
    switch (option.type) {
        case OptionType::number:
        case OptionType::integer: {
            const char* type = option.type == OptionType::integer ? "integer" : "number";
            if (!option.words.empty())
                return std::string("{ type: ") + type + ", enum: " + listOf(option.words) + " }";
            return std::string("{ type: ") + type + ", minimum: " + plainNumber(option.min) +
                   ", maximum: " + plainNumber(option.max) + " }";
        }
        case OptionType::flag:
            return "{ type: string, enum: ['0', '1', 'false', 'true'] }";
        case OptionType::word:
            return "{ type: string, enum: " + listOfWords(option.words) + " }";
        case OptionType::vector:
            return "{ type: string, pattern: '^[^,]+,[^,]+,[^,]+$', examples: ['3,2,5'] }";
        case OptionType::text:
            return "{ type: string }";
    }
    return "";
}

/// Returns the help as sentences, with units and forms of values, which the schema lacks.
std::string descriptionOf(const render::OptionSpec& option) {
    using render::OptionType;
    std::string text = option.help;
    if (option.type == OptionType::vector || option.type == OptionType::text)
        text.insert(std::min(text.find(';'), text.size()), ": " + option.range);
    else if (const std::size_t blank = option.range.find(' ');
             blank != std::string::npos && option.words.empty() && option.type != OptionType::flag)
        text.insert(std::min(text.find(';'), text.size()), ", in" + option.range.substr(blank));
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text + "." + (option.details.empty() ? "" : " " + option.details);
}

Section parameters() {
    std::string text;
    for (const render::OptionSpec& option : render::optionSpecs())
        text += option.name + ":\n  name: " + option.name +
                "\n  in: query\n  description: " + yamlText(descriptionOf(option)) +
                "\n  schema: " + schemaOf(option) + "\n";
    return {"parameters", text};
}

std::string referenceTo(const std::string& name) {
    return "- $ref: '#/components/parameters/" + name + "'\n";
}

Section references() {
    std::string text;
    for (const render::OptionSpec& option : render::optionSpecs()) text += referenceTo(option.name);
    return {"references", text};
}

/// The same for a turntable, which may be an animation in one file.
Section turntable() {
    std::string text;
    for (const render::OptionSpec& option : render::optionSpecs()) {
        if (option.name != "format") {
            text += referenceTo(option.name);
            continue;
        }
        std::vector<std::string> words;
        for (const image::AnimationSpec& animation : image::kAnimations)
            words.emplace_back(animation.name);
        words.insert(words.end(), option.words.begin(), option.words.end());
        text +=
            "- name: format\n  in: query\n"
            "  description: \"of one animation, or of each image of a multipart answer.\"\n"
            "  schema: { type: string, enum: " +
            listOf(words) + " }\n";
    }
    return {"turntable", text};
}

Section content() {
    std::string text;
    for (const image::FormatSpec& format : image::kFormats)
        text += std::string(format.mime) + ": { schema: { type: string, format: binary } }\n";
    return {"content", text};
}

}  // namespace

std::string plainNumber(double value) {
    char text[400];
    const auto [end, error] =
        std::to_chars(std::begin(text), std::end(text), value, std::chars_format::fixed);
    return error == std::errc() ? std::string(text, end) : "0";
}

std::vector<Section> openapiSections() {
    return {
        parameters(), references(), turntable(), content(), {"metrics", grade::metricsOpenApi()}};
}

}  // namespace farol::cli
