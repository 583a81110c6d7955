#include "server/service.h"

#include <nlohmann/json.hpp>

#include "server/problem.h"
#include "server/store/memory_store.h"
#include "server/version.h"

namespace farol::server {

using nlohmann::json;

namespace {

// A scene's source is XML from strangers: a browser that opens it must not run what is in it.
constexpr const char* kDataPolicy = "default-src 'none'; frame-ancestors 'none'; sandbox";

constexpr std::chrono::milliseconds kRefusalHold{200};
constexpr std::uint64_t kMemoryStoreBytes = std::uint64_t{128} << 20U;

http::Response jsonResponse(const json& value) {
    http::Response response;
    response.contentType = "application/json";
    response.body = dump(value, 2) + "\n";
    return response;
}

// Routes without parameters refuse any.
void noParameters(const Call& call) { readParameters(call.request.query, {}); }

}  // namespace

Service::Service(ServiceOptions options, Backend& backend, Logger& logger)
    : options_(std::move(options)),
      store_(options_.store ? options_.store
                            : std::make_shared<store::MemoryStore>(
                                  store::StoreLimits{kMemoryStoreBytes, 10'000})),
      backend_(backend),
      logger_(logger),
      pictures_(options_.cacheBytes),
      limiter_(options_.rate),
      scenes_(options_.scenesDir),
      router_(routes()) {
    if (const std::string fault = scenes_.watchFault(); !fault.empty())
        logger_.event("scenes", "the folder cannot be watched: " + fault +
                                    ": every request looks at its files, which costs time");
}

std::vector<Route> Service::routes() {
    using Member = http::Response (Service::*)(const Call&);
    const auto call = [this](Member member) {
        return [this, member](const Call& one) { return (this->*member)(one); };
    };
    const auto named = [this](const char* name) {
        return [this, name](const Call& one) { return file(one, name, false); };
    };
    const auto image = [this](http::Fields preset) {
        return
            [this, preset = std::move(preset)](const Call& one) { return getImage(one, preset); };
    };
    return {
        {"GET", "/", call(&Service::getPage)},
        {"GET", "/plain", named("plain.html")},
        {"GET", "/assets/{file}", call(&Service::getAsset)},
        {"GET", "/openapi.yaml", named("openapi.yaml")},
        {"GET", "/livez", call(&Service::livez)},
        {"GET", "/readyz", call(&Service::readyz)},
        {"GET", "/version", call(&Service::version)},
        {"GET", "/metrics", call(&Service::metrics)},
        {"POST", "/v1/render", call(&Service::postRender)},
        {"POST", "/v1/validate", call(&Service::postValidate)},
        {"POST", "/v1/compare", call(&Service::postCompare)},
        {"POST", "/v1/grade", call(&Service::postGrade)},
        {"GET", "/v1/scenes", call(&Service::listScenes)},
        {"POST", "/v1/scenes", call(&Service::postScene), true},
        {"GET", "/v1/scenes/{id}", call(&Service::getScene)},
        {"DELETE", "/v1/scenes/{id}", call(&Service::deleteScene), true},
        {"GET", "/v1/scenes/{id}/source", call(&Service::getSource)},
        {"GET", "/v1/scenes/{id}/models", call(&Service::getModels)},
        {"GET", "/v1/scenes/{id}/turntable", call(&Service::getTurntable)},
        {"GET", "/v1/scenes/{id}/image", image({})},
        {"GET", "/v1/scenes/{id}/thumbnail",
         image({{"width", "320"}, {"height", "240"}, {"format", "jpeg"}, {"quality", "85"}})},
        {"GET", "/v1/primitives", call(&Service::listPrimitives)},
        {"GET", "/v1/primitives/{shape}", call(&Service::getPrimitive)},
    };
}

std::size_t Service::bodyLimit(const http::Request& request) const {
    const Route* route = router_.find(request);
    if (route == nullptr) return 0;
    try {
        if (route->isWriting) authorize(request);
    } catch (const Error&) {
        return 0;
    }
    return options_.maxBodyBytes;
}

http::Response Service::handle(const http::Request& request, http::Body& body) {
    http::Response response;
    try {
        if (limiter_.isOn() && request.path.starts_with("/v1/"))
            limiter_.admit(clientOf(request, options_.rate.trustProxy));
        if (const Route* route = router_.find(request); route != nullptr && route->isWriting)
            authorize(request);
        response = router_.route(request, body);
    } catch (const Error& error) {
        Problem problem = problemOf(error);
        if (problem.status == 405)
            problem.headers.emplace_back("Allow", router_.allowed(request.path));
        if (problem.code == "http.media-type")
            problem.headers.emplace_back("Accept-Post",
                                         "application/xml, text/xml, multipart/form-data, "
                                         "application/zip, application/x-tar, application/gzip");
        if (problem.status == 401)
            problem.headers.emplace_back("WWW-Authenticate", "Bearer realm=\"farol\"");
        response = problemResponse(problem, request.id);
    } catch (const Busy& busy) {
        Problem problem{statusOf(busy.code()), busy.code(), busy.what(), {}, {}};
        if (busy.retryAfterS() > 0)
            problem.headers.emplace_back("Retry-After", std::to_string(busy.retryAfterS()));
        response = problemResponse(problem, request.id);
        // Who asks again at once must not take the processor from those who are drawn for.
        if (busy.code() == "busy.queue" && request.path.starts_with("/v1/"))
            response.hold = kRefusalHold;
    } catch (const std::exception& fault) {
        // What went wrong is for the operator; the client gets the id to ask about.
        logger_.event("internal-error", request.id + ": " + fault.what());
        response = problemResponse({500, "internal", "The server met an error of its own.", {}, {}},
                                   request.id);
    }
    if (response.status >= 400) drawProblem(request, response);
    finish(request, response);
    return response;
}

http::Response Service::refuse(const http::Request& request, int status, const std::string& code,
                               const std::string& message) {
    http::Response response = problemResponse({status, code, message, {}, {}}, request.id);
    finish(request, response);
    return response;
}

void Service::finish(const http::Request& request, http::Response& response) const {
    const auto has = [&](const char* name) {
        for (const auto& [key, value] : response.headers)
            if (key == name) return true;
        return false;
    };
    response.set("X-Request-Id", request.id);
    response.set("X-Content-Type-Options", "nosniff");
    response.set("Referrer-Policy", "no-referrer");
    if (!has("Content-Security-Policy")) response.set("Content-Security-Policy", kDataPolicy);
    if (!has("Cache-Control")) response.set("Cache-Control", "no-cache");
    if (options_.corsOrigin.empty()) return;
    response.set("Access-Control-Allow-Origin", options_.corsOrigin);
    response.set("Access-Control-Expose-Headers",
                 "ETag, Location, Server-Timing, X-Request-Id, X-Farol-Stats, X-Farol-Quality, "
                 "X-Farol-Camera, "
                 "X-Farol-Diagnostics, Retry-After");
    if (request.method == "OPTIONS") {
        response.set("Access-Control-Allow-Methods", "GET, HEAD, POST, DELETE, OPTIONS");
        response.set("Access-Control-Allow-Headers",
                     "Content-Type, If-None-Match, Authorization, X-Request-Id");
        response.set("Access-Control-Max-Age", "600");
    }
}

void Service::finished(const http::Request& request, const http::Response& response,
                       double milliseconds, bool sent) {
    const std::string route = router_.patternOf(request.path);
    metrics_.request(route.empty() ? "none" : route, response.status, milliseconds);
    logger_.request(request, response, milliseconds, sent);
    sweep();
}

http::Response Service::livez(const Call& call) {
    noParameters(call);
    return jsonResponse({{"status", "alive"}});
}

http::Response Service::readyz(const Call& call) {
    noParameters(call);
    if (draining_) throw Busy("busy.draining", "The server is shutting down.", 1);
    try {
        backend_.check();
    } catch (const Busy&) {
        throw;
    } catch (const std::exception& fault) {
        logger_.event("not-ready", fault.what());
        throw Busy("not-ready", "The renderer does not draw as it should.", 5);
    }
    const BackendState state = backend_.state();
    return jsonResponse({{"status", "ready"},
                         {"workers", state.workers},
                         {"queued", state.queued},
                         {"store", store_->isReachable() ? "reachable" : "unreachable"}});
}

http::Response Service::version(const Call& call) {
    noParameters(call);
    const BackendFacts facts = backend_.facts();
    json sandbox = json::object();
    for (const auto& [layer, state] : facts.sandbox) sandbox[layer] = state;
    return jsonResponse({{"name", "farol"},
                         {"version", projectVersion()},
                         {"renderer", backend_.version()},
                         {"gl", facts.gl},
                         {"sandbox", sandbox}});
}

http::Response Service::metrics(const Call& call) {
    noParameters(call);
    http::Response response;
    response.contentType = "text/plain; version=0.0.4; charset=utf-8";
    response.body = metrics_.text(backend_.state(), pictures_.counts(), store_->isReachable(),
                                  traffic_ ? traffic_() : http::Traffic{}, projectVersion(),
                                  backend_.version());
    response.set("Cache-Control", "no-store");
    return response;
}

}  // namespace farol::server
