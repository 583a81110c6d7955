#include "cli/schema.h"

#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/messages.h"
#include "core/did_you_mean.h"
#include "core/text.h"
#include "grade/rubric/rubric.h"
#include "scene/read/xsd.h"

namespace farol::cli {
namespace {

struct SchemaFlags {
    bool xsd = false, rubric = false, json = false, messages = false;
    std::string markdown, openapi;
};

std::string textOf(const std::vector<Section>& sections, const std::string& name) {
    std::vector<std::string> names;
    for (const Section& section : sections) {
        if (section.name == name) return section.text;
        names.push_back(section.name);
    }
    const std::string near = didYouMean(name, names);
    throw UsageError(
        message<"usage/section">("name"_arg = name, "suggestion"_arg = near,
                                 "known"_arg = uncut(near.empty() ? joined(names, ", ") : "")));
}

std::string textOf(const SchemaFlags& flags) {
    const int chosen = int{flags.xsd} + int{flags.rubric} + int{flags.json} + int{flags.messages} +
                       int{!flags.markdown.empty()} + int{!flags.openapi.empty()};
    if (chosen != 1) throw UsageError(message<"usage/schema">());
    if (flags.xsd) return scene::xmlSchema();
    if (flags.rubric) return grade::rubricSchema();
    if (flags.json) return tablesAsJson().dump(1) + "\n";
    if (flags.messages) return messagesAsJson().dump(1) + "\n";
    if (!flags.markdown.empty()) return textOf(markdownSections(), flags.markdown);
    return textOf(openapiSections(), flags.openapi);
}

}  // namespace

void addSchema(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand(
        "schema", "Prints the tables of scene language, shapes, formats, options and settings");
    const auto flags = std::make_shared<SchemaFlags>();
    const auto addSections = [&](const std::string& name, std::string& section,
                                 const std::string& help) {
        command->add_option(name, section, help)->type_name("SECTION");
    };
    command->add_flag("--xsd", flags->xsd, "the scene language as an XML schema");
    command->add_flag("--rubric", flags->rubric, "the JSON schema of rubrics");
    command->add_flag("--json", flags->json, "all tables as one JSON document");
    command->add_flag("--messages", flags->messages, "the message catalogue as JSON");
    addSections("--markdown", flags->markdown,
                "a table of the documentation: element-light, shapes, formats, options, settings, "
                "metrics or messages");
    addSections("--openapi", flags->openapi,
                "a part of the OpenAPI document: parameters, references, turntable, content or "
                "metrics");
    command->callback([&action, flags] {
        action = [flags](Report&) {
            std::cout << textOf(*flags) << std::flush;
            return kDone;
        };
    });
}

}  // namespace farol::cli
