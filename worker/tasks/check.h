#pragma once

#include <vector>

#include "worker/reply_check.h"

namespace farol::worker {

/// Draws a tiny known scene and checks its pixels: whether a worker works. Throws a problem
/// as std::runtime_error.
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
