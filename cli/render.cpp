#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "cli/animation.h"
#include "cli/command.h"
#include "cli/files.h"
#include "cli/source.h"
#include "render/renderer.h"
#include "server/json.h"

namespace farol::cli {
namespace {

struct Flags {
    std::string scene, output, assets;
    AnimationFlags animation;
    bool strict = false, stats = false, verbose = false;
    std::vector<std::pair<std::string, std::string>> picture;  ///< options in the order given
};

render::PictureOptions pictureOptions(const Flags& flags) {
    render::PictureOptions options;
    const std::string ending = endingOf(flags.output);
    bool known = flags.output == "-" || flags.output.rfind("/dev/", 0) == 0;
    for (const auto& [format, endings] :
         {std::pair{"png", std::vector{"png"}}, {"jpeg", {"jpg", "jpeg"}}, {"webp", {"webp"}}})
        for (const char* one : endings)
            if (ending == one) {
                render::applyOption(options, "format", format);
                known = true;
            }
    for (const auto& [name, value] : flags.picture) {
        render::applyOption(options, name, value);
        known = known || name == "format";
    }
    if (!known)
        throw UsageError("-o " + flags.output +
                         ": pictures end with .png, .jpg, .jpeg or .webp (or give --format)");
    return options;
}

nlohmann::json toJson(const render::StageTimes& times) {
    return {{"parse", times.parseMs},
            {"geometry", times.geometryMs},
            {"draw", times.drawMs},
            {"readback", times.readbackMs},
            {"encode", times.encodeMs}};
}

void printStats(const nlohmann::json& stats, const nlohmann::json& timesMs) {
    for (const auto& [name, value] : stats.items()) std::cerr << name << "=" << value << " ";
    for (const auto& [name, value] : timesMs.items())
        std::cerr << name << "=" << value.get<double>() << "ms ";
    std::cerr << std::endl;
}

int run(const Flags& flags, Report& report) {
    if (report.json() && flags.output == "-")
        throw UsageError("--json and -o - would both write to standard output");
    report.setVerbose(flags.verbose);
    const render::PictureOptions options = pictureOptions(flags);
    render::Job job = openSource(flags.scene, flags.assets, flags.strict);
    job.options = options;
    report.setInput(job.name);
    render::Picture picture;
    if (flags.animation.wanted()) {
        const Schedule moments = schedule(flags.animation, render::inspect(job), options.timeS);
        picture = renderAnimation(job, moments, flags.output);
        report.set("frames", moments.frames);
        report.set("fps", moments.fps);
    } else {
        picture = render::Renderer().render(job);
        writeOutput(flags.output, picture.bytes);
    }
    report.add(picture.diagnostics);
    const nlohmann::json stats = server::toJson(picture.stats), times = toJson(picture.times);
    report.set("output", flags.output);
    report.set("contentType", picture.contentType);
    report.set("width", picture.width);
    report.set("height", picture.height);
    report.set("stats", stats);
    report.set("timesMs", times);
    if (picture.quality) report.set("quality", server::toJson(*picture.quality));
    if (flags.stats && !report.json()) printStats(stats, times);
    if (flags.stats && !report.json() && picture.quality)
        std::cerr << "quality=" << server::toJson(*picture.quality) << std::endl;
    return kDone;
}

}  // namespace

void addRender(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand("render", "Draws a scene or a mesh file");
    const auto flags = std::make_shared<Flags>();
    command->add_option("SCENE", flags->scene, "an .xml scene, a mesh file, or - for stdin")
        ->type_name("")
        ->required();
    command->add_option("-o,--output", flags->output, "the picture: .png .jpg .webp, - for stdout")
        ->type_name("FILE")
        ->required();
    command
        ->add_option("--assets", flags->assets,
                     "folder of the files that the scene names; default the scene's own")
        ->type_name("DIR");
    command->add_flag("--strict", flags->strict, "takes warnings for errors");
    command->add_flag("--stats", flags->stats, "says what was drawn, and how long it took");
    command->add_flag("-v,--verbose", flags->verbose, "shows information beside warnings");
    CLI::Option* frames = command->add_option(
        "--frames", flags->animation.frames,
        "renders an animation of that many frames; they make one loop unless --fps is given");
    CLI::Option* fps =
        command->add_option("--fps", flags->animation.fps,
                            "frames a second; without --frames as many as make one loop");
    takesNumber(frames->group("Animation"), 1, 3600);
    takesNumber(fps->group("Animation"), 0.01, 1000.0);
    for (const render::OptionSpec& spec : render::optionSpecs())
        command
            ->add_option_function<std::string>(
                "--" + spec.name,
                [flags, name = spec.name](const std::string& value) {
                    flags->picture.emplace_back(name, value);
                },
                spec.help)
            ->type_name(spec.range)
            ->take_last()
            ->group("Picture");
    command->callback(
        [&action, flags] { action = [flags](Report& report) { return run(*flags, report); }; });
}

}  // namespace farol::cli
