#include "cli/animation.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <thread>
#include <vector>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/frame_pipe.h"
#include "cli/messages.h"
#include "cli/progress.h"
#include "core/text.h"
#include "image/format.h"
#include "image/frame_encoder.h"
#include "image/sheet.h"
#include "render/turn.h"

namespace farol::cli {
namespace {

constexpr int kMaxFrames = 3600;

/// Fewest frames of a process: a renderer takes as long to start as several frames.
constexpr int kLeastShare = 8;

/// None where the report is JSON.
class FrameProgress {
  public:
    explicit FrameProgress(const Report& report) {
        if (!report.json()) shown_.emplace("drawing");
    }
    void operator()(int done, int all) {
        if (shown_) (*shown_)(static_cast<std::size_t>(done), static_cast<std::size_t>(all));
    }

  private:
    std::optional<Progress> shown_;
};

/// Writes each frame as an image of the first output.
class NumberedFiles final : public image::AnimationWriter {
  public:
    NumberedFiles(int frames, const render::PictureOptions& options, Outputs& outputs)
        : AnimationWriter({frames}), options_(options), outputs_(outputs) {}

  private:
    void append(const image::Image& frame) override {
        outputs_.write(0, image::encode(frame, options_.format, options_.quality), added_);
    }
    std::string end() override { return ""; }

    const render::PictureOptions& options_;
    Outputs& outputs_;
};

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

int drawingProcesses(const AnimationFlags& flags) {
    if (flags.jobs) return *flags.jobs;
    // llvmpipe keeps two cores busy: on two, a second process gains nothing.
    const int most = std::clamp(static_cast<int>(std::thread::hardware_concurrency()) / 2, 1,
                                kMaxDrawingProcesses);
    return flags.frames ? std::clamp(*flags.frames / kLeastShare, 1, most) : most;
}

Share shareOf(int process, const AnimationFlags& flags, int frames) {
    int count = drawingProcesses(flags);
    if (!flags.jobs) count = std::clamp(frames / kLeastShare, 1, count);
    if (process >= count) return {frames, count};
    return {(frames - 1 + process) % count, count};
}

void shareProcessor(int processes) {
    if (processes == 1) return;
    const int cores = static_cast<int>(std::thread::hardware_concurrency());
    // One thread of llvmpipe is the process's own.
    const int threads = std::max(1, cores / processes);
    ::setenv("LP_NUM_THREADS", std::to_string(threads == 1 ? 0 : threads).c_str(), 0);
}

void helpAnimation(render::Job job, const Schedule& schedule, const Share& share, int socket,
                   render::GlSource gl) {
    if (share.index >= schedule.frames) return;
    const int frames = (schedule.frames - 1 - share.index) / share.count + 1;
    render::Renderer renderer(gl);  // before the first thread
    FrameSender sender(frames, socket);
    image::FrameEncoder sending(sender);
    for (int i = share.index; i < schedule.frames; i += share.count) {
        job.options.timeS = schedule.timeOf(i);
        image::Image image;
        renderer.draw(job, image);
        sending.add(std::move(image));
    }
    sending.finish();
}

render::Picture renderAnimation(render::Job job, const Schedule& schedule, const Share& share,
                                const std::string& path, Outputs& outputs, render::GlSource gl,
                                Report& report) {
    const bool files = framePath(path, 0) != path;
    const std::optional<image::AnimationFormat> format = animationFormat(path, job.options.format);
    if (!files && !format) throw UsageError(message<"usage/frames-format">());
    render::Renderer renderer(gl);  // before the first thread
    std::unique_ptr<image::AnimationWriter> animation;
    if (files)
        animation = std::make_unique<NumberedFiles>(schedule.frames, job.options, outputs);
    else
        animation = image::specOf(*format).write({schedule.frames, schedule.fps,
                                                  job.options.background == "transparent",
                                                  job.options.quality});
    image::FrameEncoder encoder(*animation);
    render::Picture last;
    FrameProgress progress(report);
    std::vector<bool> hasEnded(outputs.helpers().size());
    for (int i = 0; i < schedule.frames; ++i) {
        // Helper h draws the share after the own one's, h + 1 further.
        const int helper = (i - share.index + share.count) % share.count - 1;
        std::optional<image::Image> frame;
        if (helper >= 0 && !hasEnded.at(static_cast<std::size_t>(helper))) {
            frame = receiveFrame(outputs.helpers()[static_cast<std::size_t>(helper)]);
            hasEnded[static_cast<std::size_t>(helper)] = !frame;
        }
        if (!frame) {
            job.options.timeS = schedule.timeOf(i);
            last = renderer.draw(job, frame.emplace());
        }
        encoder.add(std::move(*frame));
        progress(i + 1, schedule.frames);
    }
    encoder.finish();
    const std::string bytes = animation->finish();
    if (!files) outputs.write(0, bytes);
    for (const bool one : hasEnded)
        if (one) report.add({diagnosticOf(Severity::warning, message<"worker.crashed/helper">())});
    last.contentType =
        files ? image::contentType(job.options.format) : std::string(image::specOf(*format).mime);
    return last;
}

render::Picture renderSheet(render::Job job, const SheetSize& size,
                            const std::optional<Schedule>& schedule, Outputs& outputs,
                            render::GlSource gl, const Report& report) {
    render::Renderer renderer(gl);
    FrameProgress progress(report);
    image::Sheet sheet(size.columns, size.rows);
    render::Picture last;
    std::optional<scene::Camera> first;
    for (int i = 0; i < size.count(); ++i) {
        if (schedule)
            job.options.timeS = schedule->timeOf(i);
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
        progress(i + 1, size.count());
    }
    const image::Image whole = sheet.take();
    outputs.write(0, image::encode(whole, job.options.format, job.options.quality));
    last.contentType = image::contentType(job.options.format);
    last.width = whole.width;
    last.height = whole.height;
    return last;
}

}  // namespace farol::cli
