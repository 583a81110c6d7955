// The scene as a file for other programs.
#include "worker/tasks/model.h"

#include "server/etag.h"
#include "server/json.h"
#include "server/messages.h"
#include "server/request/parameters.h"
#include "server/request/problem.h"
#include "server/routes/answers.h"

namespace farol::server {

http::Response getModel(Context& context, const Call& call) {
    const Parameters wanted = readParameters(call.request.query, {false, true, {"format"}, {}});
    const std::string format = wanted.ownValue("format", "glb");
    if (format != "glb")
        throw Error(message<"option.range/words">("name"_arg = "format", "value"_arg = format,
                                                  "known"_arg = "glb"),
                    {}, "format");
    ServedScene scene = context.scenes.find(call.parameter);
    const auto tagOf = [&] {
        return entityTag({scene.document, scene.version, context.backend.version(), "model", format,
                          wanted.strict ? "strict" : ""});
    };
    http::Response response;
    if (const std::string tag = tagOf(); matchesTag(call.request.header("if-none-match"), tag)) {
        response.status = 304;
        response.set("ETag", tag);
        return response;
    }
    worker::ModelTask::Request request{context.scenes.jobOf(scene)};
    request.job.strict = wanted.strict;
    worker::Done<worker::ModelTask::Reply> done =
        context.backend.run<worker::ModelTask>(std::move(request));
    response.set("ETag", tagOf());
    response.contentType = "model/gltf-binary";
    response.body = std::move(done.result.bytes);
    response.logged.emplace_back("queueMs", toMicroseconds(done.queueMs));
    const Diagnostics warnings = notable(done.result.diagnostics);
    if (!warnings.empty()) response.set("X-Farol-Diagnostics", diagnosticsHeader(warnings));
    response.set("Content-Disposition", "attachment; filename=\"" + scene.id + ".glb\"");
    return response;
}

}  // namespace farol::server
