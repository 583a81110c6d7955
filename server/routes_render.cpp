// The routes that draw: a scene from a body, a scene from the served folder.
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "scene/words.h"
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

std::string diagnosticsHeader(const json& diagnostics) {
    json kept = json::array();
    for (const json& one : diagnostics) {
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
    if (picture.quality) response.set("X-Farol-Quality", asciiJson(toJson(*picture.quality)));
    response.set("X-Farol-Camera", asciiJson(toJson(picture.camera)));
    if (const Diagnostics found = notable(picture.diagnostics); !found.empty())
        response.set("X-Farol-Diagnostics", diagnosticsHeader(toJson(found)));
    response.logged = {{"queueMs", std::to_string(done.queueMs)},
                       {"drawMs", std::to_string(picture.times.drawMs)},
                       {"encodeMs", std::to_string(picture.times.encodeMs)}};
    return response;
}

}  // namespace

namespace {

void checkOnError(const Parameters& wanted) {
    const std::string value = wanted.ownValue("onerror", "problem");
    if (value != "image" && value != "problem")
        throw Error("option.range", "onerror must be image or problem, not " + scene::quoted(value),
                    {}, "onerror");
}

/// All options that decide the picture.
std::string keyOf(const Parameters& wanted) {
    std::string key = wanted.strict ? "strict\n" : "";
    for (const auto& [name, value] : wanted.given)
        key.append(name).append("=").append(value).append("\n");
    return key + std::to_string(static_cast<int>(wanted.picture.format));
}

constexpr int kMaxFrames = 120;
constexpr std::int64_t kMaxTurnPixels = 33'554'432;

/// What a query asks for. `format=apng` is a word of this route alone, and taken out.
Turntable turntableOf(http::Fields& query, const std::optional<std::string>& accept) {
    Turntable turn;
    const auto format = std::find_if(query.begin(), query.end(),
                                     [](const auto& one) { return one.first == "format"; });
    if (format == query.end()) {
        turn.apng = acceptedQuality(accept, "image/apng") >=
                    acceptedQuality(accept, "multipart/x-mixed-replace");
    } else if (format->second == "apng") {
        turn.apng = true;
        query.erase(format);
    }
    return turn;
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
    ParameterRules rules{true, true, kDrawnNames, {}};
    rules.ownNames.emplace_back("base");
    // A fault in the query is told before the body is taken in.
    const Parameters asked = readParameters(call.request.query, rules);
    const Turn turn = turnOf(asked);
    Upload upload = takeUpload(call, asked.ownValue("base"));
    Parameters wanted = readParameters(call.request.query, rules, upload.optionsJson);
    checkOnError(wanted);
    chooseFormat(wanted, call.request.header("accept"));
    upload.job.options = wanted.picture;
    upload.job.strict = wanted.strict;
    http::Response response = drawn(backend_.render(upload.job, "", turn));
    response.set("Vary", "Accept");
    response.set("Cache-Control", "no-store");
    return response;
}

http::Response Service::postValidate(const Call& call) {
    const Parameters wanted =
        readParameters(call.request.query, {false, true, {"base", "models"}, {}});
    const bool models = wholeNumber("models", wanted.ownValue("models", "0"), 0, 1) == 1;
    Upload upload = takeUpload(call, wanted.ownValue("base"));
    upload.job.strict = wanted.strict;
    const Done<render::SceneReport> done = backend_.inspect(upload.job);
    json body = toJson(done.result);
    body["valid"] = true;
    if (models) body.update(modelsOf(done.result));
    http::Response response;
    response.contentType = "application/json";
    response.body = dump(body, 2) + "\n";
    response.set("Cache-Control", "no-store");
    return response;
}

http::Response Service::getImage(const Call& call, const http::Fields& preset) {
    Parameters wanted = readParameters(call.request.query, {true, true, kDrawnNames, preset});
    checkOnError(wanted);
    const Turn turn = turnOf(wanted);
    ServedScene scene = sceneOf(call.parameter);
    chooseFormat(wanted, call.request.header("accept"));
    const auto tagOf = [&] {
        return entityTag({scene.document, scene.version, keyOf(wanted), backend_.version()});
    };
    std::string tag = tagOf();
    http::Response response;
    if (matchesTag(call.request.header("if-none-match"), tag)) {
        response.status = 304;
    } else if (auto kept = pictures_.find(tag)) {
        response = std::move(*kept);
    } else {
        backend_.expectRoom(tag, turn);
        render::Job job = jobOfScene(scene);
        job.options = wanted.picture;
        job.strict = wanted.strict;
        tag = tagOf();
        response = drawn(backend_.render(job, tag, turn));
        pictures_.put(tag, response);
    }
    response.set("ETag", tag);
    response.set("Vary", "Accept");
    return response;
}

http::Response Service::getTurntable(const Call& call) {
    http::Fields query = call.request.query;
    const auto accept = call.request.header("accept");
    Turntable turn = turntableOf(query, accept);
    const http::Fields preset{{"width", "320"}, {"height", "240"}, {"format", "jpeg"}};
    const Parameters wanted =
        readParameters(query, {true, true, {"frames", "fps", "onerror"}, preset});
    checkOnError(wanted);
    turn.frames =
        static_cast<int>(wholeNumber("frames", wanted.ownValue("frames", "24"), 2, kMaxFrames));
    turn.fps = static_cast<double>(wholeNumber("fps", wanted.ownValue("fps", "12"), 1, 60));
    const std::int64_t pixels = std::int64_t{turn.frames} * wanted.picture.width.value_or(1) *
                                wanted.picture.height.value_or(1);
    if (pixels > kMaxTurnPixels)
        throw Error("option.range",
                    "frames times width times height must be at most " +
                        std::to_string(kMaxTurnPixels) + ", not " + std::to_string(pixels),
                    {}, "frames");
    const std::string type = turn.apng ? "image/apng" : "multipart/x-mixed-replace";
    if (acceptedQuality(accept, type) <= 0.0 &&
        (!turn.apng || acceptedQuality(accept, "image/png") <= 0.0))
        throw Error("http.not-acceptable",
                    "A turn is image/apng or multipart/x-mixed-replace, and the Accept header does "
                    "not take what was asked for.");
    ServedScene scene = sceneOf(call.parameter);
    const auto tagOf = [&] {
        return entityTag({scene.document, scene.version, keyOf(wanted), backend_.version(), type,
                          std::to_string(turn.frames), std::to_string(turn.fps)});
    };
    std::string tag = tagOf();
    http::Response response;
    if (matchesTag(call.request.header("if-none-match"), tag)) {
        response.status = 304;
    } else {
        render::Job job = jobOfScene(scene);
        job.options = wanted.picture;
        job.strict = wanted.strict;
        tag = tagOf();
        response = drawn(backend_.turntable(job, turn));
    }
    response.set("ETag", tag);
    response.set("Vary", "Accept");
    return response;
}

void Service::drawProblem(const http::Request& request, http::Response& response) {
    static constexpr const char* kDrawing[] = {"/v1/render", "/v1/scenes/{id}/image",
                                               "/v1/scenes/{id}/thumbnail",
                                               "/v1/scenes/{id}/turntable"};
    const auto wants = [](const auto& one) {
        return one.first == "onerror" && one.second == "image";
    };
    if (std::none_of(request.query.begin(), request.query.end(), wants) ||
        std::find(std::begin(kDrawing), std::end(kDrawing), router_.patternOf(request.path)) ==
            std::end(kDrawing))
        return;
    constexpr std::size_t kMostErrors = 8;
    const json problem = json::parse(response.body);
    std::string text = std::to_string(response.status) + " " + problem.value("title", "") + "\n\n";
    std::size_t told = 0;
    for (const json& one : problem.at("errors")) {
        if (told++ == kMostErrors) break;
        if (one.contains("line"))
            text += one.value("file", "") + ":" + std::to_string(one.value("line", 0)) + ":" +
                    std::to_string(one.value("column", 0)) + ": ";
        text += one.value("message", "") + " [" + one.value("code", "") + "]\n";
    }
    try {
        Parameters wanted;
        for (const auto& [name, value] : request.query)
            if (name == "width" || name == "height" || name == "format") {
                try {
                    render::applyOption(wanted.picture, name, value);
                } catch (const Error&) {  // the fault may be this very option: its default then
                }
                wanted.formatGiven = wanted.formatGiven || name == "format";
            }
        chooseFormat(wanted, request.header("accept"));
        const Done<render::Picture> done = backend_.notice(text, wanted.picture);
        response.contentType = done.result.contentType;
        response.body = done.result.bytes;
        response.set("X-Farol-Diagnostics", diagnosticsHeader(problem.at("errors")));
    } catch (const std::exception&) {
        // No worker is free, or no format is welcome: the problem goes out as it is.
    }
}

}  // namespace farol::server
