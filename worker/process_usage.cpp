#include "worker/process_usage.h"

#include <time.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace farol::worker {

std::chrono::nanoseconds cpuTimeOf(pid_t pid) {
    clockid_t clock{};
    timespec used{};
    if (pid <= 0 || clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &used) != 0)
        return {};
    return std::chrono::seconds(used.tv_sec) + std::chrono::nanoseconds(used.tv_nsec);
}

Activity activityOf(pid_t pid) {
    namespace fs = std::filesystem;
    Activity activity = Activity::blocked;
    std::error_code failed;
    fs::directory_iterator at("/proc/" + std::to_string(pid) + "/task", failed);
    for (; !failed && at != fs::directory_iterator(); at.increment(failed)) {
        std::ifstream in(at->path() / "stat");
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        const std::size_t name = text.rfind(')');  // a name may hold blanks and parentheses
        if (name == std::string::npos || name + 2 >= text.size()) continue;
        const char state = text[name + 2];
        if (state == 'T' || state == 't') return Activity::stopped;
        if (state == 'R' || state == 'D') activity = Activity::runnable;
    }
    return activity;
}

}  // namespace farol::worker
