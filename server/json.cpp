#include "server/json.h"

#include "server/http/uri.h"
#include "server/problem.h"

namespace farol::server {

using nlohmann::json;

namespace {
json toJson(const glm::dvec3& v) { return json::array({v.x, v.y, v.z}); }
}  // namespace

json toJson(const scene::Camera& camera) {
    return {{"eye", toJson(camera.eye)}, {"target", toJson(camera.target)},
            {"up", toJson(camera.up)},   {"fov", camera.fovDeg},
            {"near", camera.near},       {"far", camera.far}};
}

json toJson(const render::Stats& stats) {
    return {{"instances", stats.instances}, {"culled", stats.culled},
            {"drawCalls", stats.drawCalls}, {"textures", stats.textures},
            {"lights", stats.lights},       {"triangles", stats.triangles}};
}

json toJson(const render::SceneReport& report) {
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
                  {"textureBytes", report.textureBytes}}},
                {"diagnostics", toJson(report.diagnostics)}};
    // What a client that plays the animation shows, again and again.
    if (report.playS) {
        out["playFrom"] = report.playS->x;
        out["loopSeconds"] = report.playS->y - report.playS->x;
    }
    return out;
}

json linksOf(const ServedScene& scene) {
    const std::string self = "/v1/scenes/" + http::percentEncodePath(scene.id);
    return {{"self", self},
            {"source", self + "/source"},
            {"image", self + "/image"},
            {"thumbnail", self + "/thumbnail"}};
}

}  // namespace farol::server
