#include "cli/animation.h"

#include <unistd.h>

#include <cctype>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "cli/command.h"
#include "cli/files.h"
#include "render/apng.h"
#include "render/encode.h"

namespace farol::cli {
namespace {

constexpr int kMostFrames = 3600;

/// The name of a frame's file: `%d` or `%04d` in the pattern becomes its number. Nothing when the
/// pattern has no such place.
std::optional<std::string> numbered(const std::string& pattern, int number) {
    const std::size_t percent = pattern.find('%');
    if (percent == std::string::npos) return std::nullopt;
    std::size_t at = percent + 1;
    std::size_t width = 0;
    while (at < pattern.size() && std::isdigit(static_cast<unsigned char>(pattern[at])))
        width =
            std::min<std::size_t>(width * 10 + static_cast<std::size_t>(pattern[at++] - '0'), 20);
    if (at >= pattern.size() || pattern[at] != 'd') return std::nullopt;
    std::string digits = std::to_string(number);
    if (digits.size() < width) digits.insert(0, width - digits.size(), '0');
    return pattern.substr(0, percent) + digits + pattern.substr(at + 1);
}

void showProgress(int done, int all) {
    if (!isatty(STDERR_FILENO)) return;
    std::cerr << "\rframe " << done << " of " << all << (done == all ? "\n" : "") << std::flush;
}

}  // namespace

Schedule schedule(const AnimationFlags& flags, const render::SceneReport& report, double timeS) {
    std::optional<double> loop;
    if (report.playS) loop = report.playS->y - report.playS->x;
    if (!(flags.frames && flags.fps) && !loop)
        throw UsageError(
            report.animated
                ? "this scene has no loop shorter than an hour: give both --frames and --fps"
                : "nothing moves in this scene: give both --frames and --fps, or neither");
    Schedule made{flags.frames.value_or(0), flags.fps.value_or(0.0),
                  timeS + (report.playS ? report.playS->x : 0.0)};
    if (!flags.frames) made.frames = std::max(1, static_cast<int>(std::lround(*loop * *flags.fps)));
    // Rounded to whole frames, the loop still closes: the rate gives way.
    if (!(flags.frames && flags.fps)) made.fps = made.frames / *loop;
    if (made.frames > kMostFrames)
        throw UsageError("that is " + std::to_string(made.frames) + " frames; at most " +
                         std::to_string(kMostFrames) +
                         " are rendered: give --frames, or a lower --fps");
    return made;
}

render::Picture renderAnimation(render::Job job, const Schedule& schedule,
                                const std::string& output) {
    const bool files = numbered(output, 0).has_value();
    if (!files && job.options.format != render::Format::png)
        throw UsageError(
            "an animation is an animated PNG, or pictures numbered by a %d in their name");
    render::Renderer renderer;
    const bool alpha = job.options.background == "transparent";
    render::ApngWriter animation(schedule.frames, schedule.fps, alpha);
    render::Picture last;
    for (int i = 0; i < schedule.frames; ++i) {
        job.options.timeS = schedule.beginS + i / schedule.fps;
        render::Image image;
        last = renderer.draw(job, image);
        if (files)
            writeOutput(*numbered(output, i),
                        render::encode(image, job.options.format, job.options.quality));
        else
            animation.add(image);
        showProgress(i + 1, schedule.frames);
    }
    if (!files) writeOutput(output, animation.finish());
    last.contentType = files ? render::contentType(job.options.format) : "image/apng";
    return last;
}

}  // namespace farol::cli
