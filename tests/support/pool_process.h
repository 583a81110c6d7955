#pragma once

#include <chrono>
#include <set>
#include <thread>

#include "tests/support/children.h"
#include "worker/pool.h"

namespace farol::test {

/// The process of a pool of one, once it is there. `others` are processes of other pools.
inline pid_t workerOf(const worker::WorkerPool& pool, const std::set<pid_t>& others = {}) {
    for (;; std::this_thread::sleep_for(std::chrono::milliseconds(1))) {
        if (pool.state().workers != 1) continue;
        const std::vector<pid_t> all = childrenBut(others);
        if (all.size() == 1) return all.front();
    }
}

}  // namespace farol::test
