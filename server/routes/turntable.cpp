// The route that renders a turntable.
#include "worker/tasks/turntable.h"

#include <algorithm>

#include "server/etag.h"
#include "server/messages.h"
#include "server/request/media.h"
#include "server/routes/drawing.h"

namespace farol::server {
namespace {

constexpr int kMaxFrames = 120;
constexpr std::int64_t kMaxTurnPixels = 33'554'432;

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

}  // namespace

http::Response getTurntable(Context& context, const Call& call) {
    http::Fields query = call.request.query;
    const auto accept = call.request.header("accept");
    worker::TurntableTask::Request turn;
    turn.animation = animationOf(query, accept);
    const http::Fields preset{{"width", "320"}, {"height", "240"}, {"format", "jpeg"}};
    const Parameters wanted =
        readParameters(query, {true, true, {"frames", "fps", "onerror"}, preset});
    checkOnError(wanted);
    turn.frames =
        static_cast<int>(wholeNumber("frames", wanted.ownValue("frames", "24"), 2, kMaxFrames));
    turn.fps = static_cast<double>(wholeNumber("fps", wanted.ownValue("fps", "12"), 1, 60));
    const std::int64_t pixels = std::int64_t{turn.frames} * wanted.picture.width.value_or(1) *
                                wanted.picture.height.value_or(1);
    if (pixels > kMaxTurnPixels)
        throw Error(
            message<"option.range/frames">("value"_arg = pixels, "max"_arg = kMaxTurnPixels), {},
            "frames");
    const std::string type(turn.animation ? image::specOf(*turn.animation).mime
                                          : "multipart/x-mixed-replace");
    const bool isApng = turn.animation == image::AnimationFormat::apng;
    if (acceptedQuality(accept, type) <= 0.0 &&
        (!isApng || acceptedQuality(accept, "image/png") <= 0.0))
        throw Error(message<"http.not-acceptable">("known"_arg = type));
    ServedScene scene = context.scenes.find(call.parameter);
    const auto tagOf = [&] {
        return entityTag({scene.document, scene.version, keyOf(wanted), context.backend.version(),
                          type, std::to_string(turn.frames), std::to_string(turn.fps)});
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
        response = drawn(context, context.backend.run<worker::TurntableTask>(turn));
    }
    response.set("ETag", tag);
    response.set("Vary", "Accept");
    return response;
}

}  // namespace farol::server
