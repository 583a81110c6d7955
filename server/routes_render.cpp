// The routes that draw: a scene from a body, a scene from the served folder.
#include <cstdio>
#include <nlohmann/json.hpp>

#include "server/etag.h"
#include "server/json.h"
#include "server/media.h"
#include "server/problem.h"
#include "server/service.h"
#include "server/upload.h"

namespace farol::server {

using nlohmann::json;

namespace {

// Header values are short and ASCII; findings beyond that are for /v1/validate.
constexpr std::size_t kMaxDiagnosticsHeader = 3000;

std::string timing(const render::StageTimes& times, double queueMs) {
    char text[256];
    std::snprintf(text, sizeof text,
                  "queue;dur=%.3f, parse;dur=%.3f, geometry;dur=%.3f, draw;dur=%.3f, "
                  "readback;dur=%.3f, encode;dur=%.3f",
                  queueMs, times.parseMs, times.geometryMs, times.drawMs, times.readbackMs,
                  times.encodeMs);
    return text;
}

std::string asciiJson(const json& value) {
    return value.dump(-1, ' ', true, json::error_handler_t::replace);
}

std::string diagnosticsHeader(const Diagnostics& diagnostics) {
    json kept = json::array();
    for (const json& one : toJson(diagnostics)) {
        kept.push_back(one);
        if (asciiJson(kept).size() <= kMaxDiagnosticsHeader) continue;
        kept.erase(kept.size() - 1);
        break;
    }
    return asciiJson(kept);
}

http::Response pictureResponse(Done<render::Picture> done) {
    render::Picture& picture = done.result;
    http::Response response;
    response.contentType = picture.contentType;
    response.body = std::move(picture.bytes);
    response.set("Server-Timing", timing(picture.times, done.queueMs));
    response.set("X-Farol-Stats", asciiJson(toJson(picture.stats)));
    response.set("X-Farol-Camera", asciiJson(toJson(picture.camera)));
    if (const Diagnostics found = notable(picture.diagnostics); !found.empty())
        response.set("X-Farol-Diagnostics", diagnosticsHeader(found));
    response.logged = {{"queueMs", std::to_string(done.queueMs)},
                       {"drawMs", std::to_string(picture.times.drawMs)},
                       {"encodeMs", std::to_string(picture.times.encodeMs)}};
    return response;
}

}  // namespace

http::Response Service::drawn(Done<render::Picture> done) {
    const render::StageTimes& times = done.result.times;
    metrics_.stage("queue", done.queueMs);
    metrics_.stage("parse", times.parseMs);
    metrics_.stage("geometry", times.geometryMs);
    metrics_.stage("draw", times.drawMs);
    metrics_.stage("readback", times.readbackMs);
    metrics_.stage("encode", times.encodeMs);
    return pictureResponse(std::move(done));
}

http::Response Service::postRender(const Call& call) {
    ParameterRules rules{true, true, kTurnNames, {}};
    rules.ownNames.emplace_back("base");
    // A fault in the query is told before the body is taken in.
    const Parameters asked = readParameters(call.request.query, rules);
    const Turn turn = turnOf(asked);
    Upload upload = takeUpload(call, asked.ownValue("base"));
    Parameters wanted = readParameters(call.request.query, rules, upload.optionsJson);
    chooseFormat(wanted, call.request.header("accept"));
    upload.job.options = wanted.picture;
    upload.job.strict = wanted.strict;
    http::Response response = drawn(backend_.render(upload.job, "", turn));
    response.set("Vary", "Accept");
    response.set("Cache-Control", "no-store");
    return response;
}

http::Response Service::postValidate(const Call& call) {
    const Parameters wanted = readParameters(call.request.query, {false, true, {"base"}, {}});
    Upload upload = takeUpload(call, wanted.ownValue("base"));
    upload.job.strict = wanted.strict;
    const Done<render::SceneReport> done = backend_.inspect(upload.job);
    json body = toJson(done.result);
    body["valid"] = true;
    http::Response response;
    response.contentType = "application/json";
    response.body = dump(body, 2) + "\n";
    response.set("Cache-Control", "no-store");
    return response;
}

http::Response Service::getImage(const Call& call, const http::Fields& preset) {
    Parameters wanted = readParameters(call.request.query, {true, true, kTurnNames, preset});
    const Turn turn = turnOf(wanted);
    const ServedScene scene = sceneOf(call.parameter);
    chooseFormat(wanted, call.request.header("accept"));
    render::Job job = jobOfScene(scene);
    job.options = wanted.picture;
    job.strict = wanted.strict;
    std::string options = wanted.strict ? "strict\n" : "";
    for (const auto& [name, value] : wanted.given)
        options.append(name).append("=").append(value).append("\n");
    const std::string tag = entityTag({job.xml, scene.version, options, backend_.version(),
                                       std::to_string(static_cast<int>(job.options.format))});
    http::Response response;
    if (matchesTag(call.request.header("if-none-match"), tag)) {
        response.status = 304;
    } else if (auto kept = pictures_.find(tag)) {
        response = std::move(*kept);
    } else {
        response = drawn(backend_.render(job, tag, turn));
        pictures_.put(tag, response);
    }
    response.set("ETag", tag);
    response.set("Vary", "Accept");
    return response;
}

}  // namespace farol::server
