#include <nlohmann/json.hpp>

#include "core/text.h"
#include "generator/registry.h"
#include "server/etag.h"
#include "server/messages.h"
#include "server/request/parameters.h"
#include "server/request/problem.h"
#include "server/routes/answers.h"
#include "worker/tasks/mesh.h"

namespace farol::server {

using nlohmann::json;

http::Response listPrimitives(Context&, const Call& call) {
    refuseParameters(call);
    json shapes = json::array();
    for (const generator::ShapeEntry& shape : generator::shapes()) {
        json arguments = json::array();
        for (const generator::Argument& one : shape.arguments)
            arguments.push_back({{"name", one.name},
                                 {"integer", one.isInteger()},
                                 {"min", one.min},
                                 {"max", one.max},
                                 {"help", one.help}});
        shapes.push_back({{"name", shape.name},
                          {"summary", shape.summary},
                          {"required", shape.required},
                          {"takesFile", shape.takesFile},
                          {"arguments", arguments}});
    }
    return tagged(call, dump({{"shapes", shapes}}, 2) + "\n", "application/json");
}

http::Response getPrimitive(Context& context, const Call& call) {
    const Parameters wanted =
        readParameters(call.request.query, {false, false, {"args", "format"}, {}});
    if (generator::findShape(call.parameter) == nullptr)
        throw Error(message<"http.not-found/shape">("name"_arg = call.parameter));
    worker::MeshTask::Request job;
    const std::string arguments = wanted.ownValue("args");
    job.words = {call.parameter};
    for (const std::string_view word : split(arguments, " ,")) job.words.emplace_back(word);
    job.format = wanted.ownValue("format", "3d");
    if (job.format != "3d" && job.format != "obj" && job.format != "ply")
        throw Error(message<"option.range/words">("name"_arg = "format", "value"_arg = job.format,
                                                  "known"_arg = "3d, obj or ply"),
                    {}, "format");
    std::string key;
    for (const std::string& word : job.words) key.append(word).append("\n");
    const std::string tag = entityTag({key, job.format, context.backend.version()});
    http::Response response;
    response.set("ETag", tag);
    if (matchesTag(call.request.header("if-none-match"), tag)) {
        response.status = 304;
        return response;
    }
    try {
        worker::Done<std::string> done = context.backend.run<worker::MeshTask>(job);
        response.body = std::move(done.result);
        response.logged.emplace_back("queueMs", toMicroseconds(done.queueMs));
    } catch (const Error& error) {
        if (error.code() != "shape.argument") throw;
        // The arguments came as a parameter: the request's fault, not a document's.
        Problem problem = problemOf(error);
        problem.status = 400;
        for (Diagnostic& one : problem.diagnostics)
            if (one.field.empty()) one.field = "args";
        throw ProblemException(problem);
    }
    response.contentType = job.format == "obj" ? "model/obj" : "application/octet-stream";
    if (job.format == "3d") response.contentType = "text/plain; charset=utf-8";
    response.set("Content-Disposition",
                 "attachment; filename=\"" + job.words.front() + "." + job.format + "\"");
    return response;
}

}  // namespace farol::server
