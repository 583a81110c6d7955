#pragma once

#include "grade/rubric/subject.h"
#include "worker/reply_check.h"

namespace farol::worker {

/// Compares two pictures, or scenes that are drawn first. A scene is drawn by its job's options;
/// where they give no size and the other is a picture, it is as large.
struct CompareTask : TaskTraits {
    static constexpr const char* kName = "compare";
    struct Request {
        grade::Subject first, second;
        std::string crop, mask;  ///< as in docs/reference/http.md
        bool pictures = false;   ///< are wanted too
    };
    struct Reply {
        std::string json;        ///< grade::toJson
        std::string diff, heat;  ///< PNG
    };
    struct Bounds : ReplyLimits {
        bool pictures = false;
    };

    static Reply run(const Request& request, WorkerState& state);
    static JobFacts factsOf(const Request&) { return {"", true}; }
    static Bounds boundsOf(const Request& request);
    static void accept(Reply& reply, const Bounds& bounds);
};

}  // namespace farol::worker
