// The routes that change the store of uploads.
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "server/client_bytes.h"
#include "server/http/uri.h"
#include "server/json.h"
#include "server/messages.h"
#include "server/request/media.h"
#include "server/request/parameters.h"
#include "server/request/problem.h"
#include "server/routes/answers.h"
#include "server/routes/uploads.h"
#include "worker/tasks/inspect.h"
#include "worker/tasks/unpack.h"

namespace farol::server {
http::Response postScene(Context& context, const Call& call) {
    const Parameters wanted =
        readParameters(call.request.query, {false, true, {"public", "base"}, {}});
    const bool listed = wholeNumber("public", wanted.ownValue("public", "0"), 0, 1) == 1;
    Upload upload = takeUpload(context, call, wanted.ownValue("base"));
    // Options belong to an image, not to a scene: they are validated, but not stored.
    readParameters({}, {true, true, {}, {}}, upload.optionsJson);
    if (!upload.job.archive.empty())
        upload.bundle = std::make_shared<const scene::Bundle>(
            context.backend.run<worker::UnpackTask>({upload.job.archive}).result);
    if (!upload.bundle) upload.bundle = std::make_shared<const scene::Bundle>(bundleOf(upload.job));
    render::Job job = jobOf(upload.bundle);
    job.strict = wanted.strict;
    // A scene that cannot be drawn is not kept.
    auto inspected = context.backend.run<worker::InspectTask>({std::move(job)});
    const store::SceneStore::Put kept = context.store.putFor(
        clientOf(call.request, context.options.rate.trustProxy), *upload.bundle, listed);
    const auto facts =
        context.scenes.remember(kept.entry.id, kept.entry.id, std::move(inspected.result));
    const Language language = languageOf(call.request);
    http::Response response = freshJson(
        describe(uploadOf(kept.entry), facts->report, {}, context.options.basePath, language),
        language);
    response.status = kept.created ? 201 : 200;
    response.set("Location",
                 context.options.basePath + "/v1/scenes/" + http::percentEncodePath(kept.entry.id));
    response.logged.emplace_back("scene", kept.entry.id);
    return response;
}

http::Response deleteScene(Context& context, const Call& call) {
    refuseParameters(call);
    if (!store::isStoredId(call.parameter)) {
        context.scenes.find(call.parameter);  // or it is a 404
        Problem problem = problemOf(405, message<"http.method/served-scene">());
        problem.headers = {{"Allow", "GET, HEAD, OPTIONS"}};
        throw ProblemException(problem);
    }
    if (!context.store.remove(call.parameter))
        throw Error(message<"http.not-found/scene">("name"_arg = call.parameter));
    http::Response response;
    response.status = 204;
    return response;
}

}  // namespace farol::server
