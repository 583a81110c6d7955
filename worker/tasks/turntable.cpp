#include "worker/tasks/turntable.h"

#include <glm/gtc/constants.hpp>

#include "image/frame_encoder.h"
#include "render/plan/cost.h"
#include "render/turn.h"
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

}  // namespace

render::Picture TurntableTask::run(const Request& request, WorkerState& state) {
    render::Job job = request.job;
    std::unique_ptr<image::AnimationWriter> animation;
    std::optional<image::FrameEncoder> encoder;
    if (request.animation) {
        animation = image::specOf(*request.animation)
                        .write({request.frames, request.fps,
                                job.options.background == "transparent", job.options.quality});
        encoder.emplace(*animation);
    }
    render::Picture all;
    std::string body;
    state.renderer.budget().expectFrames(request.frames);
    for (int i = 0; i < request.frames; ++i) {
        if (i > 0)
            render::turnEye(job.options, all.camera, glm::two_pi<double>() * i / request.frames);
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
    bounds.imageBytes *= static_cast<std::uint64_t>(request.frames);
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
