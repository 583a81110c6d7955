#pragma once

#include "render/renderer.h"
#include "worker/task.h"

namespace farol::worker {

/// The facts of a job that reads one scene: its identity or else a digest of all its files. It is
/// no upload where document and files are the served folder's.
JobFacts factsOf(const render::Job& job);

}  // namespace farol::worker
