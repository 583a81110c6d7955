// The routes that draw one picture: a scene from a body, a scene that is served.
#include "worker/tasks/render.h"

#include "server/etag.h"
#include "server/request/media.h"
#include "server/routes/drawing.h"
#include "server/routes/uploads.h"

namespace farol::server {
namespace {

http::Response drawServed(Context& context, const Call& call, const http::Fields& preset) {
    Parameters wanted = readParameters(call.request.query, {true, true, kDrawnNames, preset});
    checkOnError(wanted);
    const worker::Turn turn = turnOf(wanted);
    ServedScene scene = context.scenes.find(call.parameter);
    chooseFormat(wanted, call.request.header("accept"));
    const auto tagOf = [&] {
        return entityTag({scene.document, scene.version, keyOf(wanted), context.backend.version()});
    };
    std::string tag = tagOf();
    http::Response response;
    if (matchesTag(call.request.header("if-none-match"), tag)) {
        response.status = 304;
    } else if (auto kept = context.pictures.find(tag)) {
        response = std::move(*kept);
    } else {
        context.backend.expectRoom({tag, turn});
        render::Job job = context.scenes.jobOf(scene);
        job.options = wanted.picture;
        job.strict = wanted.strict;
        tag = tagOf();
        response =
            drawn(context, context.backend.run<worker::RenderTask>({std::move(job)}, {tag, turn}));
        context.pictures.put(tag, response);
    }
    response.set("ETag", tag);
    response.set("Vary", "Accept");
    return response;
}

}  // namespace

http::Response postRender(Context& context, const Call& call) {
    ParameterRules rules{true, true, kDrawnNames, {}};
    rules.ownNames.emplace_back("base");
    // An error in the query is reported before the body is read.
    const Parameters asked = readParameters(call.request.query, rules);
    const worker::Turn turn = turnOf(asked);
    Upload upload = takeUpload(context, call, asked.ownValue("base"));
    Parameters wanted = readParameters(call.request.query, rules, upload.optionsJson);
    checkOnError(wanted);
    chooseFormat(wanted, call.request.header("accept"));
    upload.job.options = wanted.picture;
    upload.job.strict = wanted.strict;
    http::Response response = drawn(
        context, context.backend.run<worker::RenderTask>({std::move(upload.job)}, {"", turn}));
    response.set("Vary", "Accept");
    response.set("Cache-Control", "no-store");
    return response;
}

http::Response getImage(Context& context, const Call& call) {
    return drawServed(context, call, {});
}

http::Response getThumbnail(Context& context, const Call& call) {
    return drawServed(context, call,
                      {{"width", "320"}, {"height", "240"}, {"format", "jpeg"}, {"quality", "85"}});
}

}  // namespace farol::server
