#pragma once

#include "worker/reply_check.h"

namespace farol::worker {

/// Renders one image of a scene.
struct RenderTask : TaskTraits {
    static constexpr const char* kName = "render";
    static constexpr bool kIsShared = true;
    struct Request {
        render::Job job;
    };
    using Reply = render::Picture;
    using Bounds = ImageBounds;

    static Reply run(const Request& request, WorkerState& state);
    static JobFacts factsOf(const Request& request);
    static Bounds boundsOf(const Request& request);
    static void accept(Reply& reply, const Bounds& bounds) { acceptImage(reply, bounds); }
};

}  // namespace farol::worker
