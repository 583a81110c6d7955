#pragma once

#include "scene/files/bundle.h"
#include "worker/reply_check.h"

namespace farol::worker {

/// Opens an archive (scene/files/archive.h).
struct UnpackTask : TaskTraits {
    static constexpr const char* kName = "unpack";
    struct Request {
        std::string archive;
    };
    using Reply = scene::Bundle;
    struct Bounds : ReplyLimits {
        std::uint64_t fileBytes = 0;  ///< of all files together
    };

    static Reply run(const Request& request, WorkerState& state);
    static JobFacts factsOf(const Request& request);
    static Bounds boundsOf(const Request& request);
    static void accept(Reply& reply, const Bounds& bounds);
};

}  // namespace farol::worker
