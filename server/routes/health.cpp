// Routes for operators and their tools.
#include <nlohmann/json.hpp>

#include "server/messages.h"
#include "server/routes/answers.h"
#include "server/version.h"
#include "worker/messages.h"
#include "worker/tasks/check.h"

namespace farol::server {

http::Response getLivez(Context&, const Call& call) {
    refuseParameters(call);
    return jsonResponse({{"status", "alive"}});
}

http::Response getReadyz(Context& context, const Call& call) {
    refuseParameters(call);
    if (context.isDraining) throw worker::Busy(worker::message<"busy.draining">(), 1);
    context.scenes.check();
    worker::CheckTask::Request canary;
    if (const std::string& folder = context.options.scenesDir; !folder.empty())
        canary.folders = {folder};
    try {
        context.backend.run<worker::CheckTask>(canary);
    } catch (const worker::Busy&) {
        throw;
    } catch (const std::exception& fault) {
        context.logger.event("not-ready", fault.what());
        throw worker::Busy(message<"not-ready">(), 5);
    }
    const worker::BackendState state = context.backend.state();
    return jsonResponse({{"status", "ready"},
                         {"workers", state.workers},
                         {"queued", state.queued},
                         {"store", context.store.isReachable() ? "reachable" : "unreachable"}});
}

http::Response getVersion(Context& context, const Call& call) {
    refuseParameters(call);
    const worker::BackendFacts facts = context.backend.facts();
    nlohmann::json sandbox = nlohmann::json::object();
    for (const auto& [layer, state] : facts.sandbox) sandbox[layer] = state;
    return jsonResponse({{"name", "farol"},
                         {"version", projectVersion()},
                         {"renderer", context.backend.version()},
                         {"gl", facts.gl},
                         {"animations", context.options.animations},
                         {"sandbox", sandbox}});
}

http::Response getMetrics(Context& context, const Call& call) {
    refuseParameters(call);
    http::Response response;
    response.contentType = "text/plain; version=0.0.4; charset=utf-8";
    response.body = context.metrics.text(context.backend.state(), context.pictures.counts(),
                                         context.store.isReachable(), context.traffic(),
                                         context.options.droppedLogLines(), projectVersion(),
                                         context.backend.version());
    response.set("Cache-Control", "no-store");
    return response;
}

}  // namespace farol::server
