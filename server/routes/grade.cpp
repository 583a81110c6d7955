#include "worker/tasks/grade.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "core/base64.h"
#include "core/text.h"
#include "grade/rubric/grader.h"
#include "server/messages.h"
#include "server/request/media.h"
#include "server/request/parameters.h"
#include "server/request/upload.h"
#include "server/routes/answers.h"
#include "server/routes/subject.h"

namespace farol::server {
namespace {

worker::GradeTask::Request readJob(std::vector<Part> parts) {
    worker::GradeTask::Request job;
    std::optional<std::string> rubric;
    bool submission = false, reference = false;
    for (Part& part : parts) {
        const std::string name = part.name;
        const bool twice = (name == "submission" && submission) ||
                           (name == "reference" && reference) || (name == "rubric" && rubric);
        if (twice) throw Error(message<"http.multipart/repeated">("name"_arg = name), {}, name);
        if (part.content.empty())
            throw Error(message<"http.multipart/empty">("name"_arg = name), {}, shown(name));
        if (name == "submission") {
            submission = true;
            job.submission = subjectOf(std::move(part));
        } else if (name == "reference") {
            reference = true;
            job.reference = subjectOf(std::move(part));
        } else if (name == "rubric") {
            rubric = std::move(part.content);
        } else {
            throw Error(message<"http.multipart/unknown">(
                            "name"_arg = name, "known"_arg = "submission, reference and rubric"),
                        {}, shown(name));
        }
    }
    if (!submission) throw Error(message<"grade.no-submission">(), {}, "submission");
    const grade::Rubric rules =
        rubric ? grade::readRubric(*rubric, "rubric.json") : grade::defaultRubric();
    const bool isCompared = grade::comparedPoints(rules) > 0.0;
    if (!reference && isCompared) throw Error(message<"grade.no-reference">(), {}, "reference");
    if (reference && !isCompared)
        throw Error(message<"grade.needless-reference">(), {}, "reference");
    job.submission.wanted.isScene = grade::needsScene(rules);
    if (!job.submission.wanted.isScene) job.submission.job.xml.clear();  // a mesh among its files
    job.rubric = worker::packRubric(rules);
    return job;
}

constexpr std::int64_t kWithReference = 2;  // the value of pictures

/// The scene that is meant, where an archive holds those of several tasks.
void readTask(const Parameters& wanted, grade::Wanted& submission) {
    submission.task = wanted.ownValue("task");
    const std::string others = wanted.ownValue("others");
    for (const std::string_view other : split(others, ","))
        submission.others.emplace_back(trimmed(other));
}

/// Adds images to the views as data: URLs, in their order, one for each name.
void addPictures(nlohmann::json& views, const std::vector<std::string>& pictures,
                 std::initializer_list<const char*> names) {
    std::size_t at = 0;
    for (nlohmann::json& view : views)
        for (const char* name : names) {
            if (at >= pictures.size()) return;
            const std::string& bytes = pictures[at++];
            if (!bytes.empty()) view[name] = "data:image/jpeg;base64," + base64(bytes);
        }
}

}  // namespace

http::Response postGrade(Context& context, const Call& call) {
    const Parameters wanted = readParameters(
        call.request.query, {false, false, {"pictures", "missing", "task", "others"}, {}});
    const std::int64_t pictures =
        wholeNumber("pictures", wanted.ownValue("pictures", "1"), 0, kWithReference);
    render::PictureOptions options;
    render::applyOption(options, "missing", wanted.ownValue("missing", "placeholder"));
    worker::GradeTask::Request job =
        readJob(readParts(call.request, call.body, context.options.maxBodyBytes));
    job.submission.job.options.missing = options.missing;
    job.language = languageOf(call.request);
    readTask(wanted, job.submission.wanted);
    const auto done = context.backend.run<worker::GradeTask>(job);
    nlohmann::json body = parseJson(done.result.json, grade::kGradeJson);
    // For comparing a class; the client has the document.
    body.erase("traits");
    body.erase("document");
    if (pictures > 0 && body.contains("views")) {
        // Two pictures a view, in its order: the submission and the difference.
        addPictures(body["views"], done.result.pictures, {"picture", "heat"});
        if (pictures == kWithReference && !job.reference.isNone()) {
            const auto expected =
                context.backend.run<worker::ReferenceTask>({job.reference, job.rubric});
            addPictures(body["views"], expected.result.pictures, {"expected"});
        }
    }
    return freshJson(body, job.language);
}

}  // namespace farol::server
