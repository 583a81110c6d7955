#include "grade/images/compare.h"

#include <nlohmann/json.hpp>

#include "core/base64.h"
#include "core/text.h"
#include "server/messages.h"
#include "server/request/media.h"
#include "server/request/parameters.h"
#include "server/request/upload.h"
#include "server/routes/answers.h"
#include "server/routes/subject.h"
#include "worker/tasks/compare.h"
#include "worker/tasks/mesh_check.h"

namespace farol::server {
namespace {

worker::CompareTask::Request readComparison(std::vector<Part> parts) {
    worker::CompareTask::Request job;
    bool first = false, second = false;
    for (Part& part : parts) {
        const std::string name = part.name;
        if (name != "first" && name != "second")
            throw Error(message<"http.multipart/unknown">("name"_arg = name,
                                                          "known"_arg = "first and second"),
                        {}, shown(name));
        bool& seen = name == "first" ? first : second;
        if (seen || part.content.empty())
            throw Error(seen ? message<"http.multipart/repeated">("name"_arg = name)
                             : message<"http.multipart/empty">("name"_arg = name),
                        {}, name);
        seen = true;
        (name == "first" ? job.first : job.second) = subjectOf(std::move(part));
    }
    for (const auto& [name, seen] : {std::pair{"first", first}, {"second", second}})
        if (!seen) throw Error(message<"http.multipart/missing">("name"_arg = name), {}, name);
    return job;
}

/// The parts of a check of meshes: `first`, and without a shape `second`, which is expected.
worker::MeshCheckTask::Request readMeshes(std::vector<Part> parts, const std::string& shape) {
    worker::MeshCheckTask::Request job;
    job.shape = shape;
    for (Part& part : parts) {
        const std::string name = part.name;
        const bool isFirst = name == "first";
        if (!isFirst && (name != "second" || !shape.empty()))
            throw Error(
                message<"http.multipart/unknown">(
                    "name"_arg = name, "known"_arg = shape.empty() ? "first and second" : "first"),
                {}, shown(name));
        std::string& bytes = isFirst ? job.bytes : job.expectedBytes;
        if (!bytes.empty() || part.content.empty())
            throw Error(bytes.empty() ? message<"http.multipart/empty">("name"_arg = name)
                                      : message<"http.multipart/repeated">("name"_arg = name),
                        {}, name);
        bytes = std::move(part.content);
        std::string& fileName = isFirst ? job.name : job.expectedName;
        fileName = std::string(baseName(part.fileName));
        if (fileName.empty()) fileName = "mesh.3d";
    }
    for (const auto& [name, isThere] : {std::pair{"first", !job.bytes.empty()},
                                        {"second", !shape.empty() || !job.expectedBytes.empty()}})
        if (!isThere) throw Error(message<"http.multipart/missing">("name"_arg = name), {}, name);
    return job;
}

http::Response compareMeshes(Context& context, const Call& call, const std::string& shape) {
    worker::MeshCheckTask::Request job =
        readMeshes(readParts(call.request, call.body, context.options.maxBodyBytes), shape);
    job.language = languageOf(call.request);
    const auto done = context.backend.run<worker::MeshCheckTask>(job);
    return freshJson(parseJson(done.result, worker::kMeshCheckJson), job.language);
}

}  // namespace

http::Response postCompare(Context& context, const Call& call) {
    const Parameters wanted = readParameters(
        call.request.query, {true, true, {"crop", "mask", "pictures", "mesh", "shape"}, {}});
    const bool isMesh = wholeNumber("mesh", wanted.ownValue("mesh", "0"), 0, 1) == 1;
    if (const std::string shape = wanted.ownValue("shape"); isMesh || !shape.empty())
        return compareMeshes(context, call, shape);
    const std::string crop = wanted.ownValue("crop"), mask = wanted.ownValue("mask");
    if (!crop.empty() && crop != "auto") grade::readRectangle(crop, "crop");
    if (!mask.empty() && mask != "axes") grade::readRectangle(mask, "mask");
    const bool pictures = wholeNumber("pictures", wanted.ownValue("pictures", "0"), 0, 1) == 1;
    worker::CompareTask::Request job =
        readComparison(readParts(call.request, call.body, context.options.maxBodyBytes));
    job.crop = crop;
    job.mask = mask;
    job.pictures = pictures;
    for (grade::Subject* subject : {&job.first, &job.second}) {
        subject->job.options = wanted.picture;
        subject->job.strict = wanted.strict;
    }
    const auto done = context.backend.run<worker::CompareTask>(job);
    nlohmann::json body = parseJson(done.result.json, grade::kComparisonJson);
    if (pictures) {
        body["diff"] = "data:image/png;base64," + base64(done.result.diff);
        body["heat"] = "data:image/png;base64," + base64(done.result.heat);
    }
    return freshJson(body);
}

}  // namespace farol::server
