#pragma once

#include "worker/reply_check.h"

namespace farol::worker {

/// Writes a scene as binary glTF, without GL.
struct ModelTask : TaskTraits {
    static constexpr const char* kName = "model";
    static constexpr bool kIsShared = true;
    struct Request {
        render::Job job;
    };
    struct Reply {
        std::string bytes;
        Diagnostics diagnostics;
    };
    using Bounds = ReplyLimits;

    static Reply run(const Request& request, WorkerState& state);
    static JobFacts factsOf(const Request& request);
    static Bounds boundsOf(const Request& request);
    static void accept(Reply& reply, const Bounds& bounds);
};

}  // namespace farol::worker
