#include "worker/tasks/render.h"

#include "worker/scene_facts.h"
#include "worker/state.h"

namespace farol::worker {

render::Picture RenderTask::run(const Request& request, WorkerState& state) {
    return state.renderer.render(request.job);
}

JobFacts RenderTask::factsOf(const Request& request) { return worker::factsOf(request.job); }

ImageBounds RenderTask::boundsOf(const Request& request) {
    return imageBoundsOf(request.job.options);
}

}  // namespace farol::worker
