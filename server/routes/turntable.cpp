// The route that renders a turntable.
#include "worker/tasks/turntable.h"

#include <algorithm>

#include "server/etag.h"
#include "server/messages.h"
#include "server/request/media.h"
#include "server/routes/drawing.h"

namespace farol::server {
namespace {

using Animation = std::optional<image::AnimationFormat>;

/// Reads the format of an animation from the query and removes it, since other routes have none.
/// Returns nothing where each frame is an image.
Animation animationOf(http::Fields& query, const std::optional<std::string>& accept) {
    const auto format = std::find_if(query.begin(), query.end(),
                                     [](const auto& one) { return one.first == "format"; });
    if (format == query.end())
        return acceptedQuality(accept, "image/apng") >=
                       acceptedQuality(accept, "multipart/x-mixed-replace")
                   ? Animation(image::AnimationFormat::apng)
                   : Animation();
    for (std::size_t i = 0; i < image::kAnimations.size(); ++i) {
        if (image::kAnimations[i].name != format->second) continue;
        query.erase(format);
        return static_cast<image::AnimationFormat>(i);
    }
    return {};
}

/// Reads whether the camera or the time moves, and the frames: of a loop, 24 in real time without
/// `frames` and `fps`; with one of them the other follows from the scene.
void readCourse(const Parameters& wanted, worker::TurntableTask::Request& turn) {
    const std::string over = wanted.ownValue("over", "camera");
    if (over != "camera" && over != "time")
        throw Error(message<"option.range/words">("name"_arg = "over", "value"_arg = over,
                                                  "known"_arg = "camera or time"),
                    {}, "over");
    turn.isCameraTurning = over == "camera";
    const auto isGiven = [&](std::string_view name) {
        return std::any_of(wanted.own.begin(), wanted.own.end(),
                           [&](const auto& one) { return one.first == name; });
    };
    const bool followsRate = !turn.isCameraTurning && !isGiven("frames") && isGiven("fps");
    const bool followsLoop = !turn.isCameraTurning && !isGiven("fps");
    turn.frames = followsRate
                      ? 0
                      : static_cast<int>(wholeNumber("frames", wanted.ownValue("frames", "24"), 2,
                                                     worker::kMaxTurnFrames));
    turn.fps = followsLoop
                   ? 0.0
                   : static_cast<double>(wholeNumber("fps", wanted.ownValue("fps", "12"), 1, 60));
}

}  // namespace

http::Response getTurntable(Context& context, const Call& call) {
    http::Fields query = call.request.query;
    const auto accept = call.request.header("accept");
    worker::TurntableTask::Request turn;
    turn.animation = animationOf(query, accept);
    const http::Fields preset{{"width", "320"}, {"height", "240"}, {"format", "jpeg"}};
    const Parameters wanted =
        readParameters(query, {true, true, {"over", "frames", "fps", "onerror"}, preset});
    checkOnError(wanted);
    readCourse(wanted, turn);
    worker::checkTurnPixels(turn.frames, wanted.picture);
    const std::string type(turn.animation ? image::specOf(*turn.animation).mime
                                          : "multipart/x-mixed-replace");
    const bool isApng = turn.animation == image::AnimationFormat::apng;
    if (acceptedQuality(accept, type) <= 0.0 &&
        (!isApng || acceptedQuality(accept, "image/png") <= 0.0))
        throw Error(message<"http.not-acceptable">("known"_arg = type));
    ServedScene scene = context.scenes.find(call.parameter);
    const auto tagOf = [&] {
        return entityTag({scene.document, scene.version, keyOf(wanted), context.backend.version(),
                          type, turn.isCameraTurning ? "camera" : "time",
                          std::to_string(turn.frames), std::to_string(turn.fps)});
    };
    std::string tag = tagOf();
    http::Response response;
    if (matchesTag(call.request.header("if-none-match"), tag)) {
        response.status = 304;
    } else {
        turn.job = context.scenes.jobOf(scene);
        turn.job.options = wanted.picture;
        turn.job.strict = wanted.strict;
        tag = tagOf();
        worker::RunOptions run;
        run.isGone = call.request.isGone;
        response = drawn(context, context.backend.run<worker::TurntableTask>(turn, run));
    }
    response.set("ETag", tag);
    response.set("Vary", "Accept");
    return response;
}

}  // namespace farol::server
