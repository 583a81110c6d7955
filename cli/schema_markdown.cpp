#include <span>

#include "cli/schema.h"
#include "cli/settings.h"
#include "core/number.h"
#include "core/text.h"
#include "generator/registry.h"
#include "grade/formats/formats.h"
#include "grade/rubric/metrics.h"
#include "grade/rubric/severity.h"
#include "image/format.h"
#include "render/options.h"
#include "scene/read/tables.h"
#include "server/settings.h"

namespace farol::cli {
namespace {

std::string code(std::string_view word) { return "`" + std::string(word) + "`"; }

/// "`a`, `b`" of words.
template <typename Words>
std::string codes(const Words& words, const std::string& before = "`",
                  const std::string& after = "`") {
    return joined(words, ", ",
                  [&](std::string_view word) { return before + std::string(word) + after; });
}

std::string tableRow(const std::vector<std::string>& cells) {
    std::string line = "|";
    for (const std::string& cell : cells) line += " " + cell + " |";
    return line + "\n";
}

std::string tableHead(const std::vector<std::string>& titles) {
    return tableRow(titles) + tableRow(std::vector<std::string>(titles.size(), "---"));
}

/// "point (positional), spot (spotlight)": words with their aliases.
std::string wordCell(std::string_view words) {
    return joined(split(words), ", ", [](std::string_view group) {
        const std::vector<std::string_view> spellings = split(group, "|");
        const std::string aliases = joined(std::span(spellings).subspan(1), ", ");
        return code(spellings.front()) + (aliases.empty() ? "" : " (" + aliases + ")");
    });
}

std::string valueCell(const scene::AttributeSpec& row) {
    constexpr double kPositive = 1e-6;  // smaller bounds stand for "over 0"
    switch (row.kind) {
        case scene::Kind::text:
            return "text";
        case scene::Kind::flag:
            return "true, false";
        case scene::Kind::word:
            return wordCell(row.words);
        case scene::Kind::number:
        case scene::Kind::integer:
            break;
    }
    const std::string kind = row.kind == scene::Kind::integer ? "whole number" : "number";
    if (row.min > 0 && row.min < kPositive) return kind + ", over 0";
    if (row.max < kHugeNumber)
        return kind + ", " + plainNumber(row.min) + " to " + plainNumber(row.max);
    return row.min > -kHugeNumber ? kind + ", " + plainNumber(row.min) + " or more" : kind;
}

/// The heading, summary and table of an element in docs/scene-language.md.
Section elementSection(const scene::ElementSpec& element) {
    const bool isNamedColor = element.name == "namedColor";
    std::string text = isNamedColor ? std::string("### `<color> in <colors>`")
                                    : "### `<" + std::string(element.name) + ">`";
    if (!element.aliases.empty() && !isNamedColor)
        text += " (also " + codes(split(element.aliases), "`<", ">`") + ")";
    text += "\n\n" + std::string(element.summary) + "\n";
    if (element.attributes.empty() || !element.describedBy.empty())
        return {"element-" + std::string(element.name), text};
    text += "\n" + tableHead({"attribute", "also written", "value", "default", "meaning"});
    for (const scene::AttributeSpec& row : element.attributes)
        text += tableRow({code(row.name), codes(split(row.aliases)), valueCell(row),
                          std::string(row.fallback), std::string(row.meaning)});
    return {"element-" + std::string(element.name), text};
}

Section shapesSection() {
    std::string text = tableHead({"command", "shape"});
    for (const generator::ShapeEntry& shape : generator::shapes()) {
        const std::string aliases =
            shape.aliases.empty() ? "" : " (also " + codes(shape.aliases) + ")";
        text += tableRow({code(generator::usageOf(shape)) + aliases, shape.summary});
    }
    return {"shapes", text};
}

Section formatsSection() {
    std::string text = tableHead({"`format`", "media type", "file endings", "`quality`"});
    for (const image::FormatSpec& format : image::kFormats)
        text += tableRow({code(format.name), code(format.mime), codes(split(format.endings), "`."),
                          format.isLossy ? "1 to 100" : "lossless"});
    return {"formats", text};
}

Section optionsSection() {
    std::string text = tableHead({"option", "value", "meaning"});
    for (const render::OptionSpec& option : render::optionSpecs()) {
        text +=
            tableRow({code(option.name), option.words.empty() ? option.range : codes(option.words),
                      option.help + (option.details.empty() ? "" : ". " + option.details)});
    }
    return {"options", text};
}

std::string valueCell(const server::Setting& setting) {
    if (!setting.words.empty()) return codes(setting.words);
    if (!setting.form.empty()) return setting.form;
    if (setting.min < setting.max)
        return plainNumber(setting.min) + " to " + plainNumber(setting.max);
    return "true, false";
}

Section settingsSection() {
    std::string text = tableHead({"flag", "environment", "value", "default", "meaning"});
    for (const server::Setting& setting : server::settings()) {
        const std::string fallback = server::defaultText(setting);
        const std::string flag = "--" + setting.name;
        text += tableRow({code(flag), code(variableOf(flag)), valueCell(setting),
                          fallback.empty() ? "" : code(fallback), setting.help});
    }
    return {"settings", text};
}

Section gradeFormatsSection() {
    std::string text = tableHead({"`--format`", "file", "one a", "is"});
    for (const grade::Format& format : grade::formats())
        text += tableRow({code(format.name), code(format.file),
                          format.ofOne != nullptr ? "submission" : "class",
                          std::string(format.summary) + (format.isDefault ? " (default)" : "")});
    return {"grade-formats", text};
}

/// What each platform's page asks for.
Section gradeSourcesSection() {
    std::string text;
    for (const grade::Format& format : grade::formats()) {
        if (format.source.empty()) continue;
        text += "### `" + std::string(format.name) + "`\n\n";
        text += "- Page: <" + std::string(format.source) + "> (" + std::string(format.sourceDate) +
                ")\n";
        text += "- Required: " + std::string(format.required) + "\n";
        if (!format.limits.empty()) text += "- Limits: " + std::string(format.limits) + "\n";
        if (!format.environment.empty())
            text += "- Environment: " + codes(split(format.environment)) + "\n";
        text += "\n";
    }
    text.pop_back();
    return {"grade-sources", text};
}

}  // namespace

std::vector<Section> markdownSections() {
    std::vector<Section> sections{shapesSection(),
                                  formatsSection(),
                                  optionsSection(),
                                  settingsSection(),
                                  {"metrics", grade::metricsMarkdown()},
                                  {"messages", messagesMarkdown()},
                                  {"kinds", grade::kindsMarkdown()},
                                  gradeFormatsSection(),
                                  gradeSourcesSection()};
    for (const scene::ElementSpec& element : scene::elementSpecs())
        sections.push_back(elementSection(element));
    return sections;
}

}  // namespace farol::cli
