#include "server/routes/drawing.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "server/json.h"
#include "server/messages.h"
#include "server/request/problem.h"

namespace farol::server {
namespace {

std::string timing(const render::StageTimes& times, double queueMs) {
    char text[256];
    std::snprintf(text, sizeof text,
                  "queue;dur=%.3f, parse;dur=%.3f, geometry;dur=%.3f, draw;dur=%.3f, "
                  "readback;dur=%.3f, encode;dur=%.3f",
                  queueMs, times.parseMs, times.geometryMs, times.drawMs, times.readbackMs,
                  times.encodeMs);
    return text;
}

}  // namespace

http::Response drawn(Context& context, worker::Done<render::Picture> done) {
    render::Picture& picture = done.result;
    const render::StageTimes& times = picture.times;
    Metrics& metrics = context.metrics;
    metrics.stage("queue", done.queueMs);
    metrics.stage("parse", times.parseMs);
    metrics.stage("geometry", times.geometryMs);
    metrics.stage("draw", times.drawMs);
    metrics.stage("readback", times.readbackMs);
    metrics.stage("encode", times.encodeMs);
    http::Response response;
    response.contentType = picture.contentType;
    response.body = std::move(picture.bytes);
    response.set("Server-Timing", timing(times, done.queueMs));
    response.set("X-Farol-Stats", asciiJson(toJson(picture.stats)));
    if (picture.quality) response.set("X-Farol-Quality", asciiJson(toJson(*picture.quality)));
    response.set("X-Farol-Camera", asciiJson(toJson(picture.camera)));
    if (const Diagnostics found = notable(picture.diagnostics); !found.empty())
        response.set("X-Farol-Diagnostics", diagnosticsHeader(found));
    response.logged = {{"queueMs", toMicroseconds(done.queueMs)},
                       {"drawMs", toMicroseconds(times.drawMs)},
                       {"encodeMs", toMicroseconds(times.encodeMs)}};
    return response;
}

void checkOnError(const Parameters& wanted) {
    const std::string value = wanted.ownValue("onerror", "problem");
    if (value != "image" && value != "problem")
        throw Error(message<"option.range/words">("name"_arg = "onerror", "value"_arg = value,
                                                  "known"_arg = "image or problem"),
                    {}, "onerror");
}

std::string keyOf(const Parameters& wanted) {
    std::string key = wanted.strict ? "strict\n" : "";
    for (const auto& [name, value] : wanted.given)
        key.append(name).append("=").append(value).append("\n");
    return key + std::to_string(static_cast<int>(wanted.picture.format));
}

}  // namespace farol::server
