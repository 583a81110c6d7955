#pragma once

#include <vector>

#include "worker/reply_check.h"

namespace farol::worker {

/// The largest mesh that is sent to a client, in triangles: the file is held in memory.
inline constexpr std::size_t kMaxMeshTriangles = 250'000;

/// Generates a shape and writes it as a mesh file.
struct MeshTask : TaskTraits {
    static constexpr const char* kName = "mesh";
    struct Request {
        std::vector<std::string> words;  ///< {"cone", "1", "2", "4", "3"}
        std::string format;              ///< "3d", "obj" or "ply"
    };
    using Reply = std::string;  ///< the file
    using Bounds = ReplyLimits;

    static Reply run(const Request& request, WorkerState& state);
    static JobFacts factsOf(const Request&) { return {"", false}; }
    static Bounds boundsOf(const Request& request);
    static void accept(Reply& reply, const Bounds& bounds);
};

}  // namespace farol::worker
