#include "cli/animation.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <iostream>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/messages.h"
#include "core/text.h"
#include "image/format.h"

namespace farol::cli {
namespace {

constexpr int kMaxFrames = 3600;

void showProgress(int done, int all) {
    if (!isatty(STDERR_FILENO)) return;
    std::cerr << "\rframe " << done << " of " << all << (done == all ? "\n" : "") << std::flush;
}

}  // namespace

Schedule schedule(const AnimationFlags& flags, const render::SceneReport& report, double timeS) {
    std::optional<double> loop;
    if (report.playS) loop = report.playS->y - report.playS->x;
    if (!(flags.frames && flags.fps) && !loop)
        throw UsageError(report.animated ? message<"usage/frames-loop">()
                                         : message<"usage/frames-still">());
    Schedule made{flags.frames.value_or(0), flags.fps.value_or(0.0),
                  timeS + (report.playS ? report.playS->x : 0.0)};
    if (!flags.frames) made.frames = std::max(1, static_cast<int>(std::lround(*loop * *flags.fps)));
    // Rounded to whole frames, the loop still closes: the rate gives way.
    if (!(flags.frames && flags.fps)) made.fps = made.frames / *loop;
    if (made.frames > kMaxFrames)
        throw UsageError(
            message<"usage/frames">("count"_arg = made.frames, "max"_arg = kMaxFrames));
    return made;
}

std::optional<image::AnimationFormat> animationFormat(const std::string& path,
                                                      image::Format format) {
    const std::string ending = fileEnding(path);
    for (std::size_t i = 0; i < image::kAnimations.size(); ++i)
        for (const std::string_view word : split(image::kAnimations[i].endings))
            if (word == ending) return static_cast<image::AnimationFormat>(i);
    if (format == image::Format::png) return image::AnimationFormat::apng;
    if (format == image::Format::webp) return image::AnimationFormat::webp;
    return std::nullopt;
}

render::Picture renderAnimation(render::Job job, const Schedule& schedule, const std::string& path,
                                Outputs& outputs, render::GlSource gl) {
    const bool files = framePath(path, 0) != path;
    const std::optional<image::AnimationFormat> format = animationFormat(path, job.options.format);
    if (!files && !format) throw UsageError(message<"usage/frames-format">());
    render::Renderer renderer(gl);
    std::unique_ptr<image::AnimationWriter> animation;
    if (!files)
        animation = image::specOf(*format).write({schedule.frames, schedule.fps,
                                                  job.options.background == "transparent",
                                                  job.options.quality});
    render::Picture last;
    for (int i = 0; i < schedule.frames; ++i) {
        job.options.timeS = schedule.beginS + i / schedule.fps;
        image::Image image;
        last = renderer.draw(job, image);
        if (animation)
            animation->add(image);
        else
            outputs.write(0, image::encode(image, job.options.format, job.options.quality), i);
        showProgress(i + 1, schedule.frames);
    }
    if (animation) outputs.write(0, animation->finish());
    last.contentType = animation ? std::string(image::specOf(*format).mime)
                                 : image::contentType(job.options.format);
    return last;
}

}  // namespace farol::cli
