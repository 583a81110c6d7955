#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/confine.h"
#include "cli/messages.h"
#include "cli/source.h"
#include "grade/formats/formats.h"
#include "render/renderer.h"
#include "server/json.h"

namespace farol::cli {
namespace {

struct Flags {
    std::string scene, assets, format;
    bool strict = false;
    ConfinementFlags confinement;
};

int inspect(const render::Job& job, Report& report, bool isText) {
    const render::SceneReport facts = render::inspect(job);
    report.add(facts.diagnostics);
    report.merge(server::toJson(facts));
    if (!report.json() && isText)
        std::cout << textIn(report.language(),
                            message<"part.scene-valid">(
                                "name"_arg = uncut(job.name), "models"_arg = facts.models,
                                "triangles"_arg = facts.triangles, "lights"_arg = facts.lights,
                                "textures"_arg = facts.textures))
                  << std::endl;
    return kDone;
}

int run(const Flags& flags, Report& report) {
    report.setVerbose(true);
    if (!flags.format.empty() && report.json())
        throw UsageError(message<"usage/validate-format">());
    if (flags.format == "sarif") report.useWriter(grade::writeSarif, flags.scene);
    if (flags.format == "github") report.useWriter(grade::writeGithub, flags.scene);
    const render::Job job = openSource(flags.scene, flags.assets, flags.strict);
    report.setInput(job.name);
    const Confinement confinement{flags.confinement, {assetFolder(flags.scene, flags.assets)}, {}};
    return confine(confinement, report,
                   [&](Outputs&) { return inspect(job, report, flags.format.empty()); });
}

}  // namespace

void addValidate(CLI::App& root, Action& action) {
    CLI::App* command =
        root.add_subcommand("validate", "Reads a scene and says what is wrong with it");
    const auto flags = std::make_shared<Flags>();
    command->add_option("SCENE", flags->scene, "an .xml scene, a mesh file, or - for stdin")
        ->type_name("")
        ->required();
    command
        ->add_option("--assets", flags->assets,
                     "folder of the files that the scene names; default the scene's own")
        ->type_name("DIR");
    command->add_flag("--strict", flags->strict, "takes warnings for errors");
    command
        ->add_option("--format", flags->format,
                     "writes the findings for code review services, on stdout")
        ->type_name("sarif|github")
        ->check(CLI::IsMember({"sarif", "github"}));
    addConfinement(*command, flags->confinement);
    command->callback(
        [&action, flags] { action = [flags](Report& report) { return run(*flags, report); }; });
}

}  // namespace farol::cli
