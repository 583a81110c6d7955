#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/confine.h"
#include "cli/source.h"
#include "render/renderer.h"
#include "server/json.h"

namespace farol::cli {
namespace {

struct Flags {
    std::string scene, assets;
    bool strict = false;
    ConfinementFlags confinement;
};

int inspect(const render::Job& job, Report& report) {
    const render::SceneReport facts = render::inspect(job);
    report.add(facts.diagnostics);
    report.merge(server::toJson(facts));
    if (!report.json())
        std::cout << job.name << ": valid; " << facts.models << " models, " << facts.triangles
                  << " triangles, " << facts.lights << " lights, " << facts.textures << " textures"
                  << std::endl;
    return kDone;
}

int run(const Flags& flags, Report& report) {
    report.setVerbose(true);
    const render::Job job = openSource(flags.scene, flags.assets, flags.strict);
    report.setInput(job.name);
    const Confinement confinement{flags.confinement, {assetFolder(flags.scene, flags.assets)}, {}};
    return confine(confinement, report, [&](Outputs&) { return inspect(job, report); });
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
    addConfinement(*command, flags->confinement);
    command->callback(
        [&action, flags] { action = [flags](Report& report) { return run(*flags, report); }; });
}

}  // namespace farol::cli
