#include "worker/tasks/assignment.h"

namespace farol::worker {

AssignmentTask::Reply AssignmentTask::run(const Request& request, WorkerState& state) {
    const GradeTask::Request& job = request.grade;
    return grade::studentAnswer(
        state.grader.grade(job.reference, job.submission, state.rubric(job.rubric)), request.view,
        job.language);
}

ReplyLimits AssignmentTask::boundsOf(const Request&) {
    return {kBaseBytes + grade::kStudentAnswerJson.bytes, kMaxDiagnosticEntries};
}

void AssignmentTask::accept(Reply& reply, const Bounds&) {
    checkJson(reply, grade::kStudentAnswerJson, "the answer to a student");
}

}  // namespace farol::worker
