#pragma once

#include <vector>

#include "grade/rubric/subject.h"
#include "worker/reply_check.h"
#include "worker/state.h"

namespace farol::worker {

/// Grades a submission. Any worker may run it: each caches the reference after its first job.
struct GradeTask : TaskTraits {
    static constexpr const char* kName = "grade";
    struct Request {
        grade::Subject reference, submission;
        PackedRubric rubric;
        Language language = Language::en;  ///< of the texts in the JSON
    };
    struct Reply {
        std::string json;  ///< grade::toJson
        /// JPEG, two a view: the submission's picture and the difference; empty as in ViewGrade.
        std::vector<std::string> pictures;
        double readMs = 0, drawMs = 0, compareMs = 0;  ///< stages
    };
    using Bounds = ReplyLimits;

    static Reply run(const Request& request, WorkerState& state);
    static JobFacts factsOf(const Request&) { return {"", true}; }
    static Bounds boundsOf(const Request& request);
    static void accept(Reply& reply, const Bounds& bounds);
};

/// Renders a reference from a rubric's views.
struct ReferenceTask : TaskTraits {
    static constexpr const char* kName = "reference";
    struct Request {
        grade::Subject reference;
        PackedRubric rubric;
    };
    struct Reply {
        std::vector<std::string> pictures;  ///< JPEG, one a view
    };
    using Bounds = ReplyLimits;

    static Reply run(const Request& request, WorkerState& state);
    static JobFacts factsOf(const Request&) { return {"", true}; }
    static Bounds boundsOf(const Request& request);
    static void accept(Reply& reply, const Bounds& bounds);
};

}  // namespace farol::worker
