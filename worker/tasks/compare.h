#pragma once

#include "grade/rubric/subject.h"
#include "worker/reply_check.h"

namespace farol::worker {

/// Compares two images, or scenes that are rendered first. A scene is rendered by its job's
/// options; if they give no size and the other is an image, at that image's size.
struct CompareTask : TaskTraits {
    static constexpr const char* kName = "compare";
    struct Request {
        grade::Subject first, second;
        std::string crop, mask;  ///< as in docs/reference/http.md
        bool pictures = false;   ///< returns `diff` and `heat`, too
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
