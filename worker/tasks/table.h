#pragma once

#include <span>
#include <string>
#include <string_view>

#include "worker/task.h"
#include "worker/wire.h"

namespace farol::worker {

/// A kind of job as a worker finds it.
struct TaskEntry {
    std::string_view name;
    /// Reads the request, runs it and packs the reply. Throws WireError and the task's exceptions.
    std::string (*run)(Unpacker& request, WorkerState& state);
};

/// All kinds of jobs.
std::span<const TaskEntry> tasks();

}  // namespace farol::worker
