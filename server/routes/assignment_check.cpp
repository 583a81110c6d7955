// A student's check against a hidden reference.
#include <nlohmann/json.hpp>

#include "core/base64.h"
#include "core/text.h"
#include "server/messages.h"
#include "server/request/media.h"
#include "server/request/problem.h"
#include "server/request/token.h"
#include "server/request/upload.h"
#include "server/routes/answers.h"
#include "server/routes/assignment.h"
#include "server/routes/subject.h"
#include "worker/tasks/assignment.h"
#include "worker/tasks/render.h"

namespace farol::server {
namespace {

using Clock = std::chrono::steady_clock;
using nlohmann::json;

/// Returns how much later an answer leaves: at the next multiple of `step` after the request, so
/// that the time of the grading is not seen.
std::chrono::milliseconds untilStep(Clock::time_point since, std::chrono::milliseconds step) {
    const auto took = std::chrono::ceil<std::chrono::milliseconds>(Clock::now() - since) % step;
    return took.count() == 0 ? took : step - took;
}

Part readSubmission(std::vector<Part> parts) {
    for (const Part& part : parts)
        if (part.name != "submission")
            throw Error(message<"http.multipart/unknown">("name"_arg = part.name,
                                                          "known"_arg = "submission"),
                        {}, shown(part.name));
    if (parts.empty()) throw Error(message<"grade.no-submission">(), {}, "submission");
    if (parts.size() > 1)
        throw Error(message<"http.multipart/repeated">("name"_arg = "submission"), {},
                    "submission");
    if (parts.front().content.empty())
        throw Error(message<"http.multipart/empty">("name"_arg = "submission"), {}, "submission");
    return std::move(parts.front());
}

void refuseClosed(const Assignment& assignment) {
    const store::Time now = store::now();
    if (now < assignment.opens)
        throw Error(message<"assignment.closed/before">("time"_arg = timeText(assignment.opens)));
    if (now >= assignment.closes)
        throw Error(message<"assignment.closed/after">("time"_arg = timeText(assignment.closes)));
}

/// Renders the submission by itself: a job without the reference, so that nothing in its image or
/// its diagnostics can come from there.
void addOwnImage(Context& context, const Assignment& assignment, const grade::Subject& submission,
                 Language language, json& out) {
    if (submission.picture || !submission.wanted.isScene) return;
    render::Job job = submission.job;
    job.options.format = image::Format::jpeg;
    const render::Picture own = context.backend.run<worker::RenderTask>({std::move(job)}).result;
    out["image"] = "data:image/jpeg;base64," + base64(own.bytes);
    if (assignment.view.isShown(grade::Shown::document))
        setDiagnostics(out, "diagnostics", notable(own.diagnostics), language);
}

void takeTry(Context& context, const Assignment& assignment, const std::string& student,
             json& out) {
    const store::Tries tries = context.assignments.take(assignment, student);
    if (!tries.isGranted && !tries.next)
        throw Error(message<"assignment.tries/all">("count"_arg = assignment.tries));
    if (!tries.isGranted) {
        Problem problem =
            problemOf(429, message<"assignment.tries/hour">("time"_arg = timeText(*tries.next)));
        const auto waitS =
            std::chrono::ceil<std::chrono::seconds>(*tries.next - store::now()).count();
        problem.headers = {{"Retry-After", std::to_string(std::max<long>(1, waitS))}};
        throw ProblemException(problem);
    }
    out["tries"] = {{"left", tries.left},
                    {"next", tries.next ? json(timeText(*tries.next)) : json()}};
}

/// Grades the submission. Faults have one shape and leave at the same times as answers: what went
/// wrong may depend on the reference.
json gradeHidden(Context& context, const Assignment& assignment, const Call& call,
                 worker::AssignmentTask::Request request, Clock::time_point since) {
    std::string fault;
    try {
        return parseJson(context.backend.run<worker::AssignmentTask>(request).result,
                         grade::kStudentAnswerJson);
    } catch (const std::exception& thrown) {
        fault = thrown.what();
    }
    context.logger.event("assignment",
                         call.request.id + ": " + assignment.id + " cannot be checked: " + fault);
    Problem problem = problemOf(503, message<"assignment.failed">());
    problem.hold = untilStep(since, context.options.checkTime);
    throw ProblemException(problem);
}

}  // namespace

http::Response postAssignmentCheck(Context& context, const Call& call) {
    const Clock::time_point since = Clock::now();
    refuseParameters(call);
    const Assignment assignment = assignmentOf(context, call);
    const auto student =
        context.assignments.studentOf(assignment.id, bearerOf(call.request).value_or(""));
    if (!student) throw Error(message<"assignment.code">());
    refuseClosed(assignment);
    Part part = readSubmission(readParts(call.request, call.body, context.options.maxBodyBytes));
    const KeptSubmission kept{*student, std::string(baseName(part.fileName)), store::now(),
                              part.content.size(), part.content};
    const grade::Rubric rules = assignment.rules();
    worker::AssignmentTask::Request request;
    request.view = assignment.view;
    request.grade.language = languageOf(call.request);
    request.grade.rubric = worker::packRubric(rules);
    request.grade.reference = assignment.subject();
    grade::Subject& submission = request.grade.submission;
    submission = subjectOf(std::move(part));
    submission.job.options.missing = render::Missing::placeholder;
    submission.wanted.isScene = grade::needsScene(rules);
    if (!submission.wanted.isScene) submission.job.xml.clear();  // a mesh among its files
    json body = json::object();
    // A document that cannot be read costs no try.
    addOwnImage(context, assignment, submission, request.grade.language, body);
    context.backend.expectRoom({});
    takeTry(context, assignment, *student, body);
    try {
        context.assignments.keep(assignment, kept);
    } catch (const worker::Busy& full) {  // the check needs no room
        context.logger.event("store", assignment.id + ": a submission is not kept: " + full.what());
    }
    body.update(gradeHidden(context, assignment, call, std::move(request), since));
    http::Response response = freshJson(body, languageOf(call.request));
    response.hold = untilStep(since, context.options.checkTime);
    response.logged.emplace_back("assignment", assignment.id);
    return response;
}

}  // namespace farol::server
