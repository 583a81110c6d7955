#pragma once

#include "worker/reply_check.h"

namespace farol::worker {

/// Reads a scene and reports its content, without GL.
struct InspectTask : TaskTraits {
    static constexpr const char* kName = "inspect";
    struct Request {
        render::Job job;
    };
    using Reply = render::SceneReport;
    using Bounds = ReplyLimits;

    static Reply run(const Request& request, WorkerState& state);
    static JobFacts factsOf(const Request& request);
    static Bounds boundsOf(const Request& request);
    static void accept(Reply& reply, const Bounds& bounds);
};

}  // namespace farol::worker
