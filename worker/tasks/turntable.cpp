#include "worker/tasks/turntable.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/number.h"
#include "image/frame_encoder.h"
#include "render/plan/cost.h"
#include "render/turn.h"
#include "worker/messages.h"
#include "worker/scene_facts.h"
#include "worker/state.h"

namespace farol::worker {
namespace {

void appendPart(std::string& body, const render::Picture& picture) {
    body.append("--").append(kFrameBoundary).append("\r\nContent-Type: ");
    body.append(picture.contentType).append("\r\nContent-Length: ");
    body.append(std::to_string(picture.bytes.size())).append("\r\n\r\n");
    body.append(picture.bytes).append("\r\n");
}

/// The frames of an animation: frame i is at the time `beginS + i * stepS`.
struct Course {
    int frames;
    double fps;
    double beginS = 0.0, stepS = 0.0;
};

/// The course through the scene's loop: the frame after the last would be the first. Throws Error
/// option.range.
Course courseOver(const TurntableTask::Request& request) {
    constexpr double kMinFps = 0.01, kMaxFps = 60.0;
    const render::SceneReport scene = render::inspect(request.job);
    if (!scene.playS)
        throw Error(scene.animated ? message<"option.range/loop-none">()
                                   : message<"option.range/loop-still">(),
                    {}, "over");
    const double loopS = scene.playS->y - scene.playS->x;
    const double frames = request.frames > 0 ? request.frames : std::round(loopS * request.fps);
    if (frames < 2 || frames > kMaxTurnFrames)
        throw Error(message<"option.range/loop-frames">("seconds"_arg = formatNumber(loopS),
                                                        "value"_arg = formatNumber(frames),
                                                        "max"_arg = kMaxTurnFrames),
                    {}, "fps");
    const double rate = request.frames > 0 && request.fps > 0.0 ? request.fps : frames / loopS;
    return {static_cast<int>(frames), std::clamp(rate, kMinFps, kMaxFps),
            request.job.options.timeS + scene.playS->x, loopS / frames};
}

}  // namespace

void checkTurnPixels(int frames, const render::PictureOptions& options) {
    const std::int64_t pixels =
        std::int64_t{frames} * options.width.value_or(1) * options.height.value_or(1);
    if (pixels > kMaxTurnPixels)
        throw Error(
            message<"option.range/frames">("value"_arg = pixels, "max"_arg = kMaxTurnPixels), {},
            "frames");
}

render::Picture TurntableTask::run(const Request& request, WorkerState& state) {
    render::Job job = request.job;
    const Course course =
        request.isCameraTurning ? Course{request.frames, request.fps} : courseOver(request);
    checkTurnPixels(course.frames, job.options);
    std::unique_ptr<image::AnimationWriter> animation;
    std::optional<image::FrameEncoder> encoder;
    if (request.animation) {
        animation = image::specOf(*request.animation)
                        .write({course.frames, course.fps, job.options.background == "transparent",
                                job.options.quality});
        encoder.emplace(*animation);
    }
    render::Picture all;
    std::string body;
    state.renderer.budget().expectFrames(course.frames);
    for (int i = 0; i < course.frames; ++i) {
        if (state.isCancelled()) throw Cancelled();
        if (!request.isCameraTurning)
            job.options.timeS = course.beginS + i * course.stepS;
        else if (i > 0)
            render::turnEye(job.options, all.camera, glm::two_pi<double>() * i / course.frames);
        render::Picture frame;
        if (animation) {
            image::Image image;
            frame = state.renderer.draw(job, image);
            encoder->add(std::move(image));
        } else {
            frame = state.renderer.render(job);
            appendPart(body, frame);
        }
        if (i == 0) all = std::move(frame);
    }
    if (encoder) encoder->finish();
    all.bytes = animation ? animation->finish() : body + "--" + kFrameBoundary + "--\r\n";
    return all;
}

JobFacts TurntableTask::factsOf(const Request& request) { return worker::factsOf(request.job); }

TurntableTask::Bounds TurntableTask::boundsOf(const Request& request) {
    render::PictureOptions options = request.job.options;
    Bounds bounds{imageBoundsOf(options), request.animation};
    bounds.bytes -= bounds.imageBytes;
    if (request.animation)
        bounds.imageBytes =
            maxImageBytes(image::specOf(*request.animation).maxBytesPerPixel, pixelsOf(bounds));
    const int frames = request.frames > 0 ? request.frames : kMaxTurnFrames;
    bounds.imageBytes *= static_cast<std::uint64_t>(frames);
    bounds.bytes += bounds.imageBytes;
    return bounds;
}

void TurntableTask::accept(Reply& reply, const Bounds& bounds) {
    checkPicture(reply, bounds);
    if (bounds.animation) {
        const image::AnimationSpec& format = image::specOf(*bounds.animation);
        require(image::matches(reply.bytes, format.signature), "the format of an image");
        reply.contentType = format.mime;
        return;
    }
    require(reply.bytes.starts_with(std::string("--") + kFrameBoundary + "\r\n"),
            "the format of an image");
    reply.contentType = std::string("multipart/x-mixed-replace; boundary=") + kFrameBoundary;
}

}  // namespace farol::worker
