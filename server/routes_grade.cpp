// The routes that compare and grade.
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "grade/base64.h"
#include "grade/compare.h"
#include "scene/archive.h"
#include "scene/words.h"
#include "server/problem.h"
#include "server/service.h"
#include "server/upload.h"

namespace farol::server {

using nlohmann::json;

namespace {

/// A scene, an archive or a picture: the content decides.
grade::Subject subjectOf(Part part) {
    grade::Subject subject;
    subject.job.name = std::string(scene::baseName(part.fileName));
    if (subject.job.name.empty()) subject.job.name = "scene.xml";
    const std::string_view text = scene::trimmed(part.content);
    if (scene::isArchive(part.content)) {
        subject.job.archive = std::move(part.content);
    } else if (text.starts_with("<") || text.starts_with("\xEF\xBB\xBF<")) {
        const std::string& name = subject.job.name;
        subject.job.assets =
            std::make_shared<scene::BundleAssets>(scene::BundleAssets::Files{{name, part.content}});
        subject.job.xml = std::move(part.content);
    } else {
        subject.picture = std::move(part.content);
    }
    return subject;
}

GradeJob readJob(std::vector<Part> parts) {
    GradeJob job;
    bool submission = false, reference = false;
    for (Part& part : parts) {
        const std::string name = part.name;
        const bool twice = (name == "submission" && submission) ||
                           (name == "reference" && reference) ||
                           (name == "rubric" && !job.rubric.empty());
        if (twice)
            throw Error("http.multipart", "There are two parts named \"" + name + "\".", {}, name);
        if (part.content.empty())
            throw Error("http.multipart", "The part " + scene::quoted(name) + " is empty.", {},
                        scene::shown(name));
        if (name == "submission") {
            submission = true;
            job.submission = subjectOf(std::move(part));
        } else if (name == "reference") {
            reference = true;
            job.reference = subjectOf(std::move(part));
        } else if (name == "rubric") {
            job.rubric = std::move(part.content);
        } else {
            throw Error("http.multipart",
                        "The part " + scene::quoted(name) +
                            " is not known; known are submission, reference and rubric.",
                        {}, scene::shown(name));
        }
    }
    if (!submission)
        throw Error("grade.no-submission", "There is no part named \"submission\".", {},
                    "submission");
    if (!reference)
        throw Error("grade.no-reference", "There is no part named \"reference\".", {}, "reference");
    return job;
}

CompareJob readComparison(std::vector<Part> parts) {
    CompareJob job;
    bool first = false, second = false;
    for (Part& part : parts) {
        const std::string name = part.name;
        if (name != "first" && name != "second")
            throw Error(
                "http.multipart",
                "The part " + scene::quoted(name) + " is not known; known are first and second.",
                {}, scene::shown(name));
        bool& seen = name == "first" ? first : second;
        if (seen || part.content.empty())
            throw Error("http.multipart",
                        "The part \"" + name + (seen ? "\" is there twice." : "\" is empty."), {},
                        name);
        seen = true;
        (name == "first" ? job.first : job.second) = subjectOf(std::move(part));
    }
    for (const auto& [name, seen] : {std::pair{"first", first}, {"second", second}})
        if (!seen)
            throw Error("http.multipart", std::string("There is no part named \"") + name + "\".",
                        {}, name);
    return job;
}

}  // namespace

http::Response Service::postCompare(const Call& call) {
    const Parameters wanted =
        readParameters(call.request.query, {true, true, {"crop", "mask", "pictures"}, {}});
    const std::string crop = wanted.ownValue("crop"), mask = wanted.ownValue("mask");
    if (!crop.empty() && crop != "auto") grade::readRectangle(crop, "crop");
    if (!mask.empty() && mask != "axes") grade::readRectangle(mask, "mask");
    const bool pictures = wholeNumber("pictures", wanted.ownValue("pictures", "0"), 0, 1) == 1;
    CompareJob job = readComparison(readParts(call.request, call.body, options_.maxBodyBytes));
    job.crop = crop;
    job.mask = mask;
    job.pictures = pictures;
    for (grade::Subject* subject : {&job.first, &job.second}) {
        subject->job.options = wanted.picture;
        subject->job.strict = wanted.strict;
    }
    const Done<CompareReply> done = backend_.compare(job);
    json body = json::parse(done.result.json, nullptr, false);
    if (!body.is_object()) throw std::runtime_error("a worker sent no comparison");
    if (pictures) {
        body["diff"] = "data:image/png;base64," + grade::base64(done.result.diff);
        body["heat"] = "data:image/png;base64," + grade::base64(done.result.heat);
    }
    http::Response response;
    response.contentType = "application/json";
    response.body = dump(body, 2) + "\n";
    response.set("Cache-Control", "no-store");
    return response;
}

http::Response Service::postGrade(const Call& call) {
    const Parameters wanted = readParameters(call.request.query, {false, false, {"pictures"}, {}});
    const bool pictures = wholeNumber("pictures", wanted.ownValue("pictures", "1"), 0, 1) == 1;
    const GradeJob job = readJob(readParts(call.request, call.body, options_.maxBodyBytes));
    const Done<GradeReply> done = backend_.grade(job);
    json body = json::parse(done.result.json, nullptr, false);
    if (!body.is_object()) throw std::runtime_error("a worker sent no grade");
    if (pictures && body.contains("views")) {
        // Two pictures a view, in its order: the submission and the difference.
        std::size_t at = 0;
        for (json& view : body["views"]) {
            for (const char* name : {"picture", "heat"}) {
                if (at >= done.result.pictures.size()) break;
                const std::string& bytes = done.result.pictures[at++];
                if (!bytes.empty()) view[name] = "data:image/jpeg;base64," + grade::base64(bytes);
            }
        }
    }
    http::Response response;
    response.contentType = "application/json";
    response.body = dump(body, 2) + "\n";
    response.set("Cache-Control", "no-store");
    return response;
}

}  // namespace farol::server
