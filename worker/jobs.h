#pragma once

#include <string>
#include <string_view>

#include "worker/state.h"

namespace farol::worker {

/// Runs a packed job and returns the packed answer. Errors are in the answer,
/// unless there is no memory for it: std::bad_alloc.
std::string work(WorkerState& state, std::string_view job);

}  // namespace farol::worker
