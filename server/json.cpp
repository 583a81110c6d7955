#include "server/json.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "core/limit_findings.h"
#include "server/http/uri.h"
#include "server/request/problem.h"

namespace farol::server {

using nlohmann::json;

namespace {
json toJson(const glm::dvec3& v) { return json::array({v.x, v.y, v.z}); }
}  // namespace

namespace {
/// RFC 3339, to the second.
std::string timestamp(store::Time time) {
    const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
    std::tm parts{};
    gmtime_r(&seconds, &parts);
    char text[40];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}
}  // namespace

std::string asciiJson(const json& value) {
    return value.dump(-1, ' ', true, json::error_handler_t::replace);
}

std::string diagnosticsHeader(const Diagnostics& diagnostics) {
    // Header values are short; /v1/validate returns all findings.
    constexpr std::size_t kMaxBytes = 3000;
    json kept = json::array();
    Diagnostics shown = diagnostics;
    limitFindings(shown);
    for (const json& entry : toJson(shown)) {
        kept.push_back(entry);
        if (asciiJson(kept).size() <= kMaxBytes) continue;
        kept.erase(kept.size() - 1);
        break;
    }
    return asciiJson(kept);
}

json toJson(const scene::Camera& camera) {
    return {{"eye", toJson(camera.eye)}, {"target", toJson(camera.target)},
            {"up", toJson(camera.up)},   {"fov", camera.fovDeg},
            {"near", camera.near},       {"far", camera.far}};
}

json toJson(const render::Quality& quality) {
    return {{"aa", quality.samples},
            {"error", quality.errorPx},
            {"expectedMs", std::round(10.0 * quality.expectedMs) / 10.0},
            {"within", quality.within}};
}

json toJson(const render::Stats& stats) {
    return {{"instances", stats.instances},
            {"culled", stats.culled},
            {"drawCalls", stats.drawCalls},
            {"textures", stats.textures},
            {"lights", stats.lights},
            {"triangles", stats.triangles},
            {"culledGroups", stats.culledGroups},
            {"betweenSamples", stats.betweenSamples},
            {"texturesSkipped", stats.texturesSkipped},
            {"coarsened", stats.coarsened},
            {"coarsening", stats.coarsening},
            {"coplanar", stats.coplanar},
            {"exactDepth", stats.exactDepth},
            {"cutOut", stats.cutOut},
            {"blended", stats.blended},
            {"peeledLayers", stats.peeledLayers},
            {"occluders", stats.occluders},
            {"overdraw", stats.overdraw},
            {"shadowMaps", stats.shadowMaps},
            {"shadowTriangles", stats.shadowTriangles},
            {"lightsSkipped", stats.lightsSkipped}};
}

json toJson(const render::SceneReport& report, Language language) {
    json out = {{"title", report.title},
                {"description", report.description},
                {"width", report.width},
                {"height", report.height},
                {"animated", report.animated},
                {"camera", toJson(report.camera)},
                {"counts",
                 {{"models", report.models},
                  {"lights", report.lights},
                  {"textures", report.textures},
                  {"triangles", report.triangles},
                  {"textureBytes", report.textureBytes}}}};
    setDiagnostics(out, "diagnostics", report.diagnostics, language);
    // The time range that a client plays in a loop.
    if (report.playS) {
        out["playFrom"] = report.playS->x;
        out["loopSeconds"] = report.playS->y - report.playS->x;
    }
    return out;
}

json modelsOf(const render::SceneReport& report) {
    json models = json::array();
    for (const render::ModelElement& one : report.elements) {
        json entry = {{"model", one.file},
                      {"file", one.where.file},
                      {"line", one.where.line},
                      {"column", one.where.column}};
        if (!one.id.empty()) entry["id"] = one.id;
        if (!one.name.empty()) entry["name"] = one.name;
        models.push_back(std::move(entry));
    }
    return {{"models", models}, {"copies", report.copies}};
}

json linksOf(const ServedScene& scene, const std::string& basePath) {
    const std::string self = basePath + "/v1/scenes/" + http::percentEncodePath(scene.id);
    return {{"self", self},
            {"source", self + "/source"},
            {"image", self + "/image"},
            {"thumbnail", self + "/thumbnail"},
            {"turntable", self + "/turntable"},
            {"model", self + "/model"},
            {"models", self + "/models"}};
}

namespace {
/// The first error, or where there is none the first diagnostic. Precondition: there is one.
const Diagnostic& primaryOf(const Diagnostics& all) {
    const auto found = std::find_if(all.begin(), all.end(), [](const Diagnostic& one) {
        return one.severity == Severity::error;
    });
    return found == all.end() ? all.front() : *found;
}
}  // namespace

json describe(const ServedScene& scene, const render::SceneReport& report,
              const Diagnostics& errors, const std::string& basePath, Language language) {
    json out = errors.empty() ? toJson(report, language) : json::object();
    out["id"] = scene.id;
    out["valid"] = errors.empty();
    out["links"] = linksOf(scene, basePath);
    if (!errors.empty()) {
        const Diagnostic& primary = primaryOf(errors);
        setDiagnostics(out, "diagnostics", errors, language);
        out["problem"] = {{"code", primary.code}, {"message", textIn(language, primary)}};
    }
    if (out.value("title", "").empty()) {
        const std::string name = scene.id.substr(scene.id.rfind('/') + 1);
        out["title"] = name;
    }
    if (!out.contains("description")) out["description"] = "";
    out["upload"] = scene.stored.has_value();
    if (!scene.stored) return out;
    out["public"] = scene.stored->listed;
    out["bytes"] = scene.stored->bytes;
    out["expires"] = scene.stored->expires == store::Time::max()
                         ? json()
                         : json(timestamp(scene.stored->expires));
    return out;
}

}  // namespace farol::server
