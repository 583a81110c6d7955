#include "cli/schema.h"
#include "cli/settings.h"
#include "core/number.h"
#include "core/text.h"
#include "generator/registry.h"
#include "grade/formats/formats.h"
#include "grade/rubric/metrics.h"
#include "grade/rubric/rubric.h"
#include "grade/rubric/severity.h"
#include "image/animation.h"
#include "image/format.h"
#include "render/options.h"
#include "scene/read/tables.h"
#include "server/settings.h"

namespace farol::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Sets the entry unless the text is empty.
void setText(Json& object, const char* key, std::string_view text) {
    if (!text.empty()) object[key] = text;
}

/// Whole numbers without a fraction.
Json number(double value) {
    const auto whole = static_cast<std::int64_t>(value);
    return static_cast<double>(whole) == value ? Json(whole) : Json(value);
}

Json wordList(std::string_view words, std::string_view separators = kBlanks) {
    Json list = Json::array();
    for (const std::string_view word : split(words, separators)) list.push_back(word);
    return list;
}

const char* nameOf(scene::Kind kind) {
    switch (kind) {
        case scene::Kind::number:
            return "number";
        case scene::Kind::integer:
            return "integer";
        case scene::Kind::flag:
            return "flag";
        case scene::Kind::text:
            return "text";
        case scene::Kind::word:
            return "word";
    }
    return "";
}

const char* nameOf(render::OptionType type) {
    switch (type) {
        case render::OptionType::number:
            return "number";
        case render::OptionType::integer:
            return "integer";
        case render::OptionType::flag:
            return "flag";
        case render::OptionType::word:
            return "word";
        case render::OptionType::vector:
            return "vector";
        case render::OptionType::text:
            return "text";
    }
    return "";
}

Json toJson(const scene::AttributeSpec& row) {
    Json out{{"name", row.name}};
    if (!row.aliases.empty()) out["aliases"] = wordList(row.aliases);
    out["type"] = nameOf(row.kind);
    const bool isNumber = row.kind == scene::Kind::number || row.kind == scene::Kind::integer;
    if (isNumber && row.min > -kHugeNumber) out["min"] = number(row.min);
    if (isNumber && row.max < kHugeNumber) out["max"] = number(row.max);
    if (row.clamped) out["clamped"] = true;
    // Each word with its other spellings.
    for (const std::string_view group : split(row.words))
        out["words"].push_back(wordList(group, "|"));
    setText(out, "default", row.fallback);
    setText(out, "meaning", row.meaning);
    return out;
}

Json toJson(const scene::ElementSpec& element) {
    Json out{{"name", element.name}};
    if (!element.aliases.empty()) out["aliases"] = wordList(element.aliases);
    setText(out, "summary", element.summary);
    if (element.isText()) out["text"] = true;
    if (!element.children.empty()) out["children"] = wordList(element.children);
    for (const scene::AttributeSpec& row : element.attributes)
        out["attributes"].push_back(toJson(row));
    return out;
}

Json toJson(const generator::ShapeEntry& shape) {
    Json out{{"name", shape.name}};
    if (!shape.aliases.empty()) out["aliases"] = shape.aliases;
    out["usage"] = generator::usageOf(shape);
    out["summary"] = shape.summary;
    out["takesFile"] = shape.takesFile;
    out["required"] = shape.required;
    out["arguments"] = Json::array();
    for (const generator::Argument& argument : shape.arguments)
        out["arguments"].push_back({{"name", argument.name},
                                    {"integer", argument.isInteger()},
                                    {"min", number(argument.min)},
                                    {"max", number(argument.max)},
                                    {"help", argument.help}});
    return out;
}

Json toJson(const image::FormatSpec& format) {
    return {{"name", format.name},
            {"mime", format.mime},
            {"endings", wordList(format.endings)},
            {"lossy", format.isLossy}};
}

Json toJson(const image::AnimationSpec& format) {
    return {{"name", format.name},
            {"mime", format.mime},
            {"endings", wordList(format.endings)},
            {"needsModule", format.needsModule}};
}

Json toJson(const render::OptionSpec& option) {
    Json out{{"name", option.name}, {"type", nameOf(option.type)}};
    if (option.min < option.max) {
        out["min"] = number(option.min);
        out["max"] = number(option.max);
    }
    if (!option.words.empty()) out["words"] = option.words;
    out["range"] = option.range;
    out["help"] = option.help;
    setText(out, "details", option.details);
    return out;
}

Json toJson(const server::Setting& setting) {
    Json out{{"name", setting.name},
             {"flag", "--" + setting.name},
             {"environment", variableOf("--" + setting.name)}};
    if (setting.min < setting.max) {
        out["min"] = number(setting.min);
        out["max"] = number(setting.max);
    }
    if (!setting.words.empty()) out["words"] = setting.words;
    setText(out, "form", setting.form);
    setText(out, "default", server::defaultText(setting));
    out["help"] = setting.help;
    return out;
}

Json toJson(const grade::Format& format) {
    Json out{{"name", format.name},
             {"file", format.file},
             {"of", format.ofOne != nullptr ? "submission" : "class"},
             {"default", format.isDefault},
             {"summary", format.summary}};
    for (const auto& [key, text] : {std::pair{"source", format.source},
                                    {"sourceDate", format.sourceDate},
                                    {"required", format.required},
                                    {"limits", format.limits},
                                    {"environment", format.environment}})
        if (!text.empty()) out[key] = text;
    return out;
}

Json toJson(const grade::MetricSpec& metric) {
    Json out{{"name", metric.name}, {"summary", metric.summary}, {"weight", number(metric.weight)}};
    if (const grade::ImageMetric* image = metric.image()) {
        out["pictures"] = metric.appliesToPictures();
        out["tolerance"] = number(image->tolerance);
        out["limit"] = number(image->limit);
    } else {
        out["perFinding"] = number(metric.causes()->perFinding);
    }
    return out;
}

Json toJson(const grade::Kind& kind) {
    return {{"code", kind.code},
            {"criterion", grade::kTopicWords[kind.topic]},
            {"least", number(kind.least)},
            {"most", number(kind.most)}};
}

template <typename Rows>
Json listOf(const Rows& rows) {
    Json list = Json::array();
    for (const auto& row : rows) list.push_back(toJson(row));
    return list;
}

}  // namespace

Json tablesAsJson() {
    return {{"elements", listOf(scene::elementSpecs())},
            {"shapes", listOf(generator::shapes())},
            {"formats", listOf(image::kFormats)},
            {"animations", listOf(image::kAnimations)},
            {"options", listOf(render::optionSpecs())},
            {"settings", listOf(server::settings())},
            {"gradeFormats", listOf(grade::formats())},
            {"gradeMeasures", listOf(grade::metrics())},
            {"gradeKinds", listOf(grade::kinds())},
            {"rubric", Json::parse(grade::rubricSchema())},
            {"defaultRubric", Json::parse(grade::writeRubric(grade::defaultRubric()))}};
}

}  // namespace farol::cli
