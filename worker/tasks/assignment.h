#pragma once

#include "grade/report/student_answer.h"
#include "worker/tasks/grade.h"

namespace farol::worker {

/// Grades a student's submission against a hidden reference. The reply holds only what the student
/// may see: the rest of the grade stays in the worker.
struct AssignmentTask : TaskTraits {
    static constexpr const char* kName = "assignment";
    struct Request {
        GradeTask::Request grade;
        grade::StudentView view;
    };
    using Reply = std::string;  ///< JSON: grade::studentAnswer
    using Bounds = ReplyLimits;

    static Reply run(const Request& request, WorkerState& state);
    static JobFacts factsOf(const Request&) { return {"", true}; }
    static Bounds boundsOf(const Request& request);
    static void accept(Reply& reply, const Bounds& bounds);
};

}  // namespace farol::worker
