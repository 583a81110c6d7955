#include "worker/tasks/mesh.h"

#include "generator/io/mesh_file.h"
#include "generator/registry.h"
#include "worker/messages.h"

namespace farol::worker {
namespace {
constexpr std::uint64_t kMeshBytes = std::uint64_t{96} << 20U;  // 250,000 triangles as OBJ
}  // namespace

std::string MeshTask::run(const Request& request, WorkerState&) {
    const scene::BundleAssets noFiles;
    const generator::ShapeCall call = generator::parseCall(request.words);
    const std::size_t triangles = generator::countTriangles(call, noFiles);
    if (triangles > kMaxMeshTriangles)
        throw Error(message<"limit.triangles/mesh">("count"_arg = triangles,
                                                    "max"_arg = kMaxMeshTriangles));
    const auto format = generator::io::formatOf("mesh." + request.format);
    if (!format)
        throw Error(message<"option.range/mesh-format">("value"_arg = request.format), {},
                    "format");
    return generator::io::encodeMesh(generator::generate(call, noFiles), *format);
}

ReplyLimits MeshTask::boundsOf(const Request&) {
    return {kBaseBytes + kMeshBytes, kMaxDiagnosticEntries};
}

void MeshTask::accept(Reply& reply, const Bounds&) {
    require(reply.size() <= kMeshBytes, "the bytes of a mesh");
}

}  // namespace farol::worker
