#include "worker/tasks/table.h"

#include "render/plan/cost.h"
#include "worker/job.h"
#include "worker/state.h"
#include "worker/tasks/assignment.h"
#include "worker/tasks/check.h"
#include "worker/tasks/compare.h"
#include "worker/tasks/grade.h"
#include "worker/tasks/inspect.h"
#include "worker/tasks/mesh.h"
#include "worker/tasks/mesh_check.h"
#include "worker/tasks/model.h"
#include "worker/tasks/notice.h"
#include "worker/tasks/render.h"
#include "worker/tasks/turntable.h"
#include "worker/tasks/unpack.h"

namespace farol::worker {
namespace {

template <Task T>
std::string runPacked(Unpacker& unpacker, WorkerState& state) {
    typename T::Request request;
    unpacker(request);
    unpacker.end();
    state.renderer.budget() = render::CostBudget(T::kIsExempt ? 0.0 : state.maxCost);
    return pack(AnswerHead{}, T::run(request, state));
}

template <Task T>
constexpr TaskEntry entryOf() {
    return {T::kName, runPacked<T>};
}

}  // namespace

std::span<const TaskEntry> tasks() {
    static constexpr TaskEntry kTasks[] = {
        entryOf<AssignmentTask>(), entryOf<CheckTask>(),     entryOf<CompareTask>(),
        entryOf<GradeTask>(),      entryOf<InspectTask>(),   entryOf<MeshTask>(),
        entryOf<MeshCheckTask>(),  entryOf<ModelTask>(),     entryOf<NoticeTask>(),
        entryOf<RenderTask>(),     entryOf<ReferenceTask>(), entryOf<TurntableTask>(),
        entryOf<UnpackTask>()};
    return kTasks;
}

}  // namespace farol::worker
