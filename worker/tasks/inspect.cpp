#include "worker/tasks/inspect.h"

#include "worker/scene_facts.h"

namespace farol::worker {
namespace {
constexpr std::uint64_t kReportBytes = std::uint64_t{32} << 20U;  // names of 50,000 elements
constexpr std::uint64_t kReportEntries = 300'000;                 // elements and their copies
}  // namespace

render::SceneReport InspectTask::run(const Request& request, WorkerState&) {
    return render::inspect(request.job);
}

JobFacts InspectTask::factsOf(const Request& request) { return worker::factsOf(request.job); }

ReplyLimits InspectTask::boundsOf(const Request&) {
    return {kBaseBytes + kReportBytes, kMaxDiagnosticEntries + kReportEntries};
}

void InspectTask::accept(Reply& report, const Bounds&) {
    checkDiagnostics(report.diagnostics);
    require(report.models >= 0 && report.lights >= 0 && report.textures >= 0 &&
                report.triangles >= 0 && report.textureBytes >= 0,
            "a count");
}

}  // namespace farol::worker
