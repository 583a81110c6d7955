#include "cli/deadline.h"

#include <unistd.h>

#include <chrono>
#include <iostream>
#include <utility>

#include "cli/command.h"
#include "cli/messages.h"

namespace farol::cli {

Deadline::Deadline(double seconds, const Report& report, std::string name) {
    if (seconds <= 0.0) return;
    thread_ = std::thread([this, seconds, json = report.json(), name = std::move(name)] {
        expire(seconds, json, name);
    });
}

void Deadline::expire(double seconds, bool json, const std::string& name) {
    std::unique_lock lock(mutex_);
    if (released_.wait_for(lock, std::chrono::duration<double>(seconds),
                           [this] { return isReleased_; }))
        return;
    // The lock is kept: the work cannot end meanwhile.
    Report late;
    if (json) late.useJson();
    late.setInput(name);
    late.add({diagnosticOf(Severity::error, message<"limit.deadline">("seconds"_arg = seconds))});
    late.finish(kInputFault);
    std::cout.flush();
    std::cerr.flush();
    _exit(kInputFault);
}

void Deadline::release() {
    {
        const std::lock_guard lock(mutex_);
        isReleased_ = true;
    }
    released_.notify_all();
    if (thread_.joinable()) thread_.join();
}

}  // namespace farol::cli
