#pragma once

#include <string>

#include "core/language.h"
#include "worker/reply_check.h"

namespace farol::worker {

/// Checks a mesh file against another one, or against a shape.
struct MeshCheckTask : TaskTraits {
    static constexpr const char* kName = "mesh-check";
    struct Request {
        std::string bytes, name;                  ///< of the file
        std::string expectedBytes, expectedName;  ///< of the other file; empty: `shape`
        std::string shape;                        ///< "sphere 1 10 10"
        Language language = Language::en;         ///< of the findings
    };
    using Reply = std::string;  ///< JSON: MeshCheck
    using Bounds = ReplyLimits;

    static Reply run(const Request& request, WorkerState& state);
    static JobFacts factsOf(const Request&) { return {"", true}; }
    static Bounds boundsOf(const Request& request);
    static void accept(Reply& reply, const Bounds& bounds);
};

inline constexpr JsonLimits kMeshCheckJson{.bytes = 262'144, .stringBytes = 4'096};

}  // namespace farol::worker
