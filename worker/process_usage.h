#pragma once

#include <sys/types.h>

#include <chrono>

/// Resource usage of another process, from the kernel.
namespace farol::worker {

/// Processor time of all threads so far; zero where the process is gone.
std::chrono::nanoseconds cpuTimeOf(pid_t pid);

enum class Activity {
    blocked,   ///< every thread waits
    runnable,  ///< a thread runs, waits for a core or for the disk
    stopped,   ///< by a signal or a debugger
};
/// `blocked` where the process is gone.
Activity activityOf(pid_t pid);

}  // namespace farol::worker
