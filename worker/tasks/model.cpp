#include "worker/tasks/model.h"

#include "interchange/write.h"
#include "worker/scene_facts.h"

namespace farol::worker {
namespace {
constexpr std::uint64_t kModelBytes = std::uint64_t{64} << 20U;  // in memory of both processes
}  // namespace

ModelTask::Reply ModelTask::run(const Request& request, WorkerState&) {
    interchange::WrittenScene written = interchange::writeGlb(request.job, kModelBytes);
    return {std::move(written.bytes), std::move(written.diagnostics)};
}

JobFacts ModelTask::factsOf(const Request& request) { return worker::factsOf(request.job); }

ReplyLimits ModelTask::boundsOf(const Request&) {
    return {kBaseBytes + kModelBytes, kMaxDiagnosticEntries};
}

void ModelTask::accept(Reply& reply, const Bounds&) {
    checkDiagnostics(reply.diagnostics);
    require(reply.bytes.size() <= kModelBytes, "the bytes of a model");
    require(reply.bytes.starts_with("glTF"), "the format of a model");
}

}  // namespace farol::worker
