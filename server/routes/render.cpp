// The routes that draw one picture: a scene from a body, a scene that is served.
#include "worker/tasks/render.h"

#include "server/etag.h"
#include "server/messages.h"
#include "server/request/media.h"
#include "server/routes/drawing.h"
#include "server/routes/uploads.h"

namespace farol::server {
namespace {

ParameterRules imageRules(const http::Fields& preset) {
    ParameterRules rules{true, true, kDrawnNames, preset};
    rules.ownNames.emplace_back("superseded");
    return rules;
}

bool isEmptyWhenSuperseded(const Parameters& wanted) {
    const std::string value = wanted.ownValue("superseded", "problem");
    if (value != "empty" && value != "problem")
        throw Error(message<"option.range/words">("name"_arg = "superseded", "value"_arg = value,
                                                  "known"_arg = "empty or problem"),
                    {}, "superseded");
    return value == "empty";
}

/// Returns what `draw` returns. With `isEmpty`, an image that a newer one of its session overtook
/// is 204 in place of a problem: browsers log every status from 400 on as an error.
template <typename Draw>
http::Response orEmpty(bool isEmpty, const Draw& draw) {
    try {
        return draw();
    } catch (const worker::Busy& busy) {
        if (!isEmpty || busy.code() != "busy.superseded") throw;
        http::Response response;
        response.status = 204;
        response.set("Cache-Control", "no-store");
        return response;
    }
}

http::Response drawServed(Context& context, const Call& call, const http::Fields& preset) {
    Parameters wanted = readParameters(call.request.query, imageRules(preset));
    checkOnError(wanted);
    const bool isEmpty = isEmptyWhenSuperseded(wanted);
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
        response = orEmpty(isEmpty, [&] {
            context.backend.expectRoom({tag, turn});
            render::Job job = context.scenes.jobOf(scene);
            job.options = wanted.picture;
            job.strict = wanted.strict;
            tag = tagOf();
            return drawn(context,
                         context.backend.run<worker::RenderTask>({std::move(job)}, {tag, turn}));
        });
        if (response.status == 204) return response;
        context.pictures.put(tag, response);
    }
    response.set("ETag", tag);
    response.set("Vary", "Accept");
    return response;
}

}  // namespace

http::Response postRender(Context& context, const Call& call) {
    ParameterRules rules = imageRules({});
    rules.ownNames.emplace_back("base");
    // An error in the query is reported before the body is read.
    const Parameters asked = readParameters(call.request.query, rules);
    const worker::Turn turn = turnOf(asked);
    Upload upload = takeUpload(context, call, asked.ownValue("base"));
    Parameters wanted = readParameters(call.request.query, rules, upload.optionsJson);
    checkOnError(wanted);
    const bool isEmpty = isEmptyWhenSuperseded(wanted);
    chooseFormat(wanted, call.request.header("accept"));
    upload.job.options = wanted.picture;
    upload.job.strict = wanted.strict;
    http::Response response = orEmpty(isEmpty, [&] {
        return drawn(context,
                     context.backend.run<worker::RenderTask>({std::move(upload.job)}, {"", turn}));
    });
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
