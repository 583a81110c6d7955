#include "worker/tasks/grade.h"

#include "grade/rubric/grader.h"

namespace farol::worker {
namespace {

constexpr std::uint64_t kGradeImages = std::uint64_t{96} << 20U;  // of all views together
constexpr std::size_t kMaxViews = 16, kMaxTimes = 8;              // of a rubric
constexpr std::size_t kMaxImages = 2 * kMaxViews * kMaxTimes;

void checkViews(const std::vector<std::string>& pictures) {
    require(pictures.size() <= kMaxImages, "too many images");
    for (const std::string& image : pictures)
        require(image.empty() || (image.size() <= kGradeImages &&
                                  image::hasSignature(image, image::Format::jpeg)),
                "an image of a grade");
}

}  // namespace

GradeTask::Reply GradeTask::run(const Request& request, WorkerState& state) {
    grade::Grade grade =
        state.grader.grade(request.reference, request.submission, state.rubric(request.rubric));
    Reply reply;
    reply.json = grade::toJson(grade, request.language);
    reply.readMs = grade.times.readMs;
    reply.drawMs = grade.times.drawMs;
    reply.compareMs = grade.times.compareMs;
    for (grade::ViewGrade& view : grade.views) {
        reply.pictures.push_back(std::move(view.picture).value_or(""));
        reply.pictures.push_back(std::move(view.heat).value_or(""));
    }
    return reply;
}

ReplyLimits GradeTask::boundsOf(const Request&) {
    return {kBaseBytes + kGradeImages + grade::kGradeJson.bytes,
            kMaxDiagnosticEntries + kMaxImages};
}

void GradeTask::accept(Reply& reply, const Bounds&) {
    checkTimes({reply.readMs, reply.drawMs, reply.compareMs});
    checkViews(reply.pictures);
    checkJson(reply.json, grade::kGradeJson, "the grade");
}

ReferenceTask::Reply ReferenceTask::run(const Request& request, WorkerState& state) {
    return {state.grader.picturesOf(request.reference, state.rubric(request.rubric))};
}

ReplyLimits ReferenceTask::boundsOf(const Request&) {
    return {kBaseBytes + kGradeImages, kMaxDiagnosticEntries + kMaxImages};
}

void ReferenceTask::accept(Reply& reply, const Bounds&) { checkViews(reply.pictures); }

}  // namespace farol::worker
