#pragma once

#include <functional>
#include <string>

namespace farol::worker {

/// Receives what the pool has to report, a name and a text each; may be called from many threads.
using EventLog = std::function<void(const std::string& name, const std::string& message)>;

}  // namespace farol::worker
