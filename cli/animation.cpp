#include "cli/animation.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <numbers>
#include <optional>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/messages.h"
#include "core/text.h"
#include "image/format.h"
#include "image/frame_encoder.h"
#include "image/sheet.h"
#include "render/turn.h"

namespace farol::cli {
namespace {

constexpr int kMaxFrames = 3600;

void showProgress(int done, int all) {
    if (!isatty(STDERR_FILENO)) return;
    std::cerr << "\rframe " << done << " of " << all << (done == all ? "\n" : "") << std::flush;
}

}  // namespace

SheetSize sheetSize(const std::string& text) {
    SheetSize size;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%3dx%3d%c", &size.columns, &size.rows, &rest) != 2 ||
        size.columns < 1 || size.rows < 1 || size.columns > kMaxSheetSide ||
        size.rows > kMaxSheetSide)
        throw UsageError(message<"usage/sheet">("value"_arg = text, "max"_arg = kMaxSheetSide));
    return size;
}

Schedule schedule(const AnimationFlags& given, const render::SceneReport& report, double timeS) {
    AnimationFlags flags = given;
    if (flags.sheet) flags.frames = flags.sheet->count();
    if (flags.isVideo && !flags.frames && !flags.fps) flags.fps = kVideoFps;
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
    std::unique_ptr<image::AnimationWriter> animation;
    std::optional<image::FrameEncoder> encoder;
    if (!files) {
        animation = image::specOf(*format).write({schedule.frames, schedule.fps,
                                                  job.options.background == "transparent",
                                                  job.options.quality});
        encoder.emplace(*animation);
    }
    render::Renderer renderer(gl);
    render::Picture last;
    for (int i = 0; i < schedule.frames; ++i) {
        job.options.timeS = schedule.beginS + i / schedule.fps;
        image::Image image;
        last = renderer.draw(job, image);
        if (animation)
            encoder->add(std::move(image));
        else
            outputs.write(0, image::encode(image, job.options.format, job.options.quality), i);
        showProgress(i + 1, schedule.frames);
    }
    if (animation) {
        encoder->finish();
        outputs.write(0, animation->finish());
    }
    last.contentType = animation ? std::string(image::specOf(*format).mime)
                                 : image::contentType(job.options.format);
    return last;
}

render::Picture renderSheet(render::Job job, const SheetSize& size,
                            const std::optional<Schedule>& schedule, Outputs& outputs,
                            render::GlSource gl) {
    render::Renderer renderer(gl);
    image::Sheet sheet(size.columns, size.rows);
    render::Picture last;
    std::optional<scene::Camera> first;
    for (int i = 0; i < size.count(); ++i) {
        if (schedule)
            job.options.timeS = schedule->beginS + i / schedule->fps;
        else if (first)
            render::turnEye(job.options, *first, 2.0 * std::numbers::pi * i / size.count());
        image::Image image;
        last = renderer.draw(job, image);
        if (!first) {
            first = last.camera;
            const std::int64_t pixels = std::int64_t{last.width} * last.height * size.count();
            if (pixels > render::kMaxPixels)
                throw UsageError(message<"usage/sheet-pixels">("count"_arg = pixels,
                                                               "max"_arg = render::kMaxPixels));
        }
        sheet.add(image);
        showProgress(i + 1, size.count());
    }
    const image::Image whole = sheet.take();
    outputs.write(0, image::encode(whole, job.options.format, job.options.quality));
    last.contentType = image::contentType(job.options.format);
    last.width = whole.width;
    last.height = whole.height;
    return last;
}

}  // namespace farol::cli
