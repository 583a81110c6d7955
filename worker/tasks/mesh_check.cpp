#include "worker/tasks/mesh_check.h"

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "generator/call.h"
#include "generator/compare/mesh_check.h"
#include "generator/io/mesh_file.h"
#include "generator/registry.h"

namespace farol::worker {
namespace {

generator::Mesh expectedOf(const MeshCheckTask::Request& request) {
    if (request.shape.empty()) {
        Diagnostics repairs;
        return generator::io::decodeMesh(request.expectedBytes, request.expectedName, repairs);
    }
    const std::vector<std::string_view> words = split(request.shape);
    return generator::generate(generator::parseCall({words.begin(), words.end()}),
                               scene::BundleAssets());
}

nlohmann::ordered_json toJson(const Diagnostic& one, Language language) {
    nlohmann::ordered_json out{
        {"code", one.code}, {"severity", kSeverityWords[one.severity]}, {"file", one.where.file}};
    if (one.where.line > 0) out["line"] = one.where.line;
    out["message"] = textIn(language, one);
    return out;
}

}  // namespace

MeshCheckTask::Reply MeshCheckTask::run(const Request& request, WorkerState&) {
    const generator::MeshCheck found =
        generator::checkMesh(request.bytes, request.name, expectedOf(request));
    nlohmann::ordered_json out{{"same", found.isRight()},
                               {"triangles", found.triangles},
                               {"expectedTriangles", found.expectedTriangles},
                               {"places", found.places},
                               {"expectedPlaces", found.expectedPlaces},
                               {"findings", nlohmann::ordered_json::array()}};
    for (const Diagnostic& one : found.findings)
        out["findings"].push_back(toJson(one, request.language));
    return dumpJson(out);
}

ReplyLimits MeshCheckTask::boundsOf(const Request&) { return kBaseLimits; }

void MeshCheckTask::accept(Reply& reply, const Bounds&) {
    checkJson(reply, kMeshCheckJson, "the check of a mesh");
}

}  // namespace farol::worker
