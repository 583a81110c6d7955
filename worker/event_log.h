#pragma once

#include <functional>
#include <string>

namespace farol::worker {

/// Receives the pool's events, a name and a text each; may be called from many threads.
using EventLog = std::function<void(const std::string& name, const std::string& message)>;

}  // namespace farol::worker
