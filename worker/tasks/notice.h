#pragma once

#include "worker/reply_check.h"

namespace farol::worker {

/// Renders a text in lines on a dark background, at the size of the options (480 x 270 px where
/// unset).
struct NoticeTask : TaskTraits {
    static constexpr const char* kName = "notice";
    struct Request {
        std::string text;
        render::PictureOptions options;  ///< size, format and quality
    };
    using Reply = render::Picture;
    using Bounds = ImageBounds;

    static Reply run(const Request& request, WorkerState& state);
    static JobFacts factsOf(const Request&) { return {"", true}; }
    static Bounds boundsOf(const Request& request) { return imageBoundsOf(request.options); }
    static void accept(Reply& reply, const Bounds& bounds) { acceptImage(reply, bounds); }
};

}  // namespace farol::worker
