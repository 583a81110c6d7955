#include <algorithm>
#include <iostream>
#include <memory>
#include <utility>
#include <vector>

#include "cli/animation.h"
#include "cli/command.h"
#include "cli/confine.h"
#include "cli/deadline.h"
#include "cli/files.h"
#include "cli/heap.h"
#include "cli/messages.h"
#include "cli/source.h"
#include "core/text.h"
#include "image/format.h"
#include "render/renderer.h"
#include "server/json.h"

namespace farol::cli {
namespace {

/// Of the process that draws, where it may have as much: it holds most first images.
constexpr int kHeapBytes = 160 << 20;

struct Flags {
    std::string scene, output, assets, sheet;
    AnimationFlags animation;
    ConfinementFlags confinement;
    bool strict = false, stats = false, verbose = false;
    render::GlSource gl = render::GlSource::automatic;
    double deadlineS = 0.0;                                    ///< 0: none
    std::vector<std::pair<std::string, std::string>> picture;  ///< options in the order given
};

render::PictureOptions pictureOptions(const Flags& flags) {
    render::PictureOptions options;
    const std::string ending = fileEnding(flags.output);
    const bool isAnimation = flags.animation.isAnyGiven() && !flags.animation.sheet;
    bool known = flags.output == "-" || flags.output.rfind("/dev/", 0) == 0;
    for (const image::FormatSpec& format : image::kFormats)
        for (const std::string_view one : split(format.endings))
            if (ending == one) {
                render::applyOption(options, "format", std::string(format.name));
                known = true;
            }
    std::string animations;
    for (const image::AnimationSpec& format : image::kAnimations)
        for (const std::string_view word : split(format.endings)) {
            known = known || (isAnimation && ending == word);
            animations.append(animations.empty() ? "." : ", .").append(word);
        }
    for (const auto& [name, value] : flags.picture) {
        render::applyOption(options, name, value);
        known = known || name == "format";
    }
    if (!known)
        throw UsageError(message<"usage/format">(
            "path"_arg = flags.output,
            "known"_arg = uncut(
                isAnimation ? animations
                            : image::listFormats(&image::FormatSpec::endings, ", ", " or ", "."))));
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

/// Layers of the sandbox that this system lacks.
void printMissing(const worker::Layers& layers) {
    for (const auto& [name, state] : layers)
        if (state.rfind("missing", 0) == 0)
            std::cerr << "sandbox." << name << "=\"" << state << "\"" << std::endl;
}

void prepareHeap(const Flags& flags) {
    if (flags.confinement.memoryMiB == 0 || flags.confinement.memoryMiB >= 1'024)
        growHeap(kHeapBytes);
}

int draw(const Flags& flags, const render::Job& job, Report& report, Outputs& outputs) {
    prepareHeap(flags);
    Deadline deadline(flags.deadlineS, report, job.name);
    render::Picture picture;
    if (flags.animation.sheet) {
        const render::SceneReport scene = render::inspect(job);
        std::optional<Schedule> moments;
        if (scene.playS || flags.animation.fps)
            moments = schedule(flags.animation, scene, job.options.timeS);
        picture = renderSheet(job, *flags.animation.sheet, moments, outputs, flags.gl, report);
        report.set("frames", flags.animation.sheet->count());
    } else if (flags.animation.isAnyGiven()) {
        const Schedule moments = schedule(flags.animation, render::inspect(job), job.options.timeS);
        const Share share =
            outputs.helpers().empty() ? Share{} : shareOf(0, flags.animation, moments.frames);
        shareProcessor(share.count);
        picture = renderAnimation(job, moments, share, flags.output, outputs, flags.gl, report);
        report.set("frames", moments.frames);
        report.set("fps", moments.fps);
        report.set("processes", share.count);
    } else {
        picture = render::Renderer(flags.gl).render(job);
        deadline.release();
        outputs.write(0, picture.bytes);
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
    if (flags.stats && !report.json()) printMissing(outputs.layers());
    // With missing=placeholder there is an image beside the errors.
    const bool hasErrors =
        std::any_of(picture.diagnostics.begin(), picture.diagnostics.end(),
                    [](const Diagnostic& one) { return one.severity == Severity::error; });
    return hasErrors ? kInputFault : kDone;
}

/// Draws a share of an animation in a helper.
void help(const Flags& flags, const render::Job& job, int index, int socket) {
    prepareHeap(flags);
    const Schedule moments = schedule(flags.animation, render::inspect(job), job.options.timeS);
    const Share share = shareOf(index + 1, flags.animation, moments.frames);
    shareProcessor(share.count);
    helpAnimation(job, moments, share, socket, flags.gl);
}

/// Whether the name asks for a format that has no still images.
bool isVideoName(const std::string& path) {
    const std::string ending = fileEnding(path);
    const auto hasEnding = [&](std::string_view endings) {
        const auto words = split(endings);
        return std::find(words.begin(), words.end(), ending) != words.end();
    };
    return std::any_of(image::kAnimations.begin(), image::kAnimations.end(),
                       [&](const image::AnimationSpec& one) { return hasEnding(one.endings); }) &&
           std::none_of(image::kFormats.begin(), image::kFormats.end(),
                        [&](const image::FormatSpec& one) { return hasEnding(one.endings); });
}

int run(Flags flags, Report& report) {
    if (!flags.sheet.empty()) flags.animation.sheet = sheetSize(flags.sheet);
    flags.animation.isVideo = !flags.animation.sheet && isVideoName(flags.output);
    if (report.json() && flags.output == "-")
        throw UsageError(message<"usage/output-twice">("output"_arg = "-o -"));
    report.setVerbose(flags.verbose);
    const render::PictureOptions options = pictureOptions(flags);
    render::Job job = openSource(flags.scene, flags.assets, flags.strict);
    job.options = options;
    report.setInput(job.name);
    Confinement confinement{
        flags.confinement, {assetFolder(flags.scene, flags.assets)}, {flags.output}};
    if (flags.animation.isAnyGiven() && !flags.animation.sheet)
        confinement.helpers = drawingProcesses(flags.animation) - 1;
    return confine(
        confinement, report, [&](Outputs& outputs) { return draw(flags, job, report, outputs); },
        [&](int index, int socket) { help(flags, job, index, socket); });
}

}  // namespace

void addRender(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand("render", "Draws a scene or a mesh file");
    const auto flags = std::make_shared<Flags>();
    command->add_option("SCENE", flags->scene, "an .xml scene, a mesh file, or - for stdin")
        ->type_name("")
        ->required();
    command
        ->add_option(
            "-o,--output", flags->output,
            "the image: " + image::listFormats(&image::FormatSpec::endings, " ", " ", ".") +
                ", - for stdout")
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
        "renders an animation (.png, .webp, .gif, .mp4, .webm) of that many frames; they make one "
        "loop unless --fps is given");
    CLI::Option* fps = command->add_option("--fps", flags->animation.fps,
                                           "frames a second; without --frames as many as make one "
                                           "loop; default 24 for .mp4, .webm and "
                                           ".gif");
    command
        ->add_option(
            "--sheet", flags->sheet,
            "renders one image of many: frames of one loop, or of a still scene views from "
            "all sides; --width and --height are those of each")
        ->type_name("COLUMNSxROWS")
        ->group("Animation");
    CLI::Option* jobs = command->add_option(
        "--jobs", flags->animation.jobs,
        "processes that draw an animation; default one for two cores; 1 where the sandbox is off");
    takesNumber(command->add_option("--deadline", flags->deadlineS,
                                    "ends with limit.deadline after that many s; 0: no deadline"),
                0.0, 86'400.0);
    addGlSource(*command, flags->gl);
    addConfinement(*command, flags->confinement);
    takesNumber(frames->group("Animation"), 1, 3600);
    takesNumber(fps->group("Animation"), 0.01, 1000.0);
    takesNumber(jobs->group("Animation"), 1, kMaxDrawingProcesses);
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
            ->group("Image");
    command->callback(
        [&action, flags] { action = [flags](Report& report) { return run(*flags, report); }; });
}

}  // namespace farol::cli
