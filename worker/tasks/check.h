#pragma once

#include <vector>

#include "worker/reply_check.h"

namespace farol::worker {

/// Renders a tiny known scene and checks its pixels, as a health check of a worker. Throws
/// std::runtime_error if they are wrong.
struct CheckTask : TaskTraits {
    static constexpr const char* kName = "check";
    static constexpr bool kIsExempt = true;
    struct Request {
        std::vector<std::string> folders;  ///< that the worker must be able to read
    };
    struct Reply {};
    using Bounds = ReplyLimits;

    static Reply run(const Request& request, WorkerState& state);
    static JobFacts factsOf(const Request&) { return {"", false}; }
    static Bounds boundsOf(const Request&) { return kBaseLimits; }
    static void accept(Reply&, const Bounds&) {}
};

/// Renders small scenes to compile the commonest shaders, and checks one of the images. Throws
/// std::runtime_error if it is wrong; propagates exceptions of Renderer::render.
void warmUp(render::Renderer& renderer);

}  // namespace farol::worker
