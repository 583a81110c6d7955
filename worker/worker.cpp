#include "worker/worker.h"

#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <optional>

#include "worker/channel.h"
#include "worker/hello.h"
#include "worker/jobs.h"
#include "worker/tasks/check.h"
#include "worker/wire.h"

namespace farol::worker {

int runWorker(const SandboxOptions& options, double maxCost, render::GlSource source) {
    // ^C and a service manager's SIGTERM reach the whole group; the parent decides when we end.
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) signal(number, SIG_IGN);
    Channel channel(kSocket);
    Hello hello;
    enterSandbox(options, hello.sandbox);
    std::optional<WorkerState> state;
    try {
        state.emplace(maxCost, source);
        warmUp(state->renderer);
        hello.gl = state->renderer.gl().description();
    } catch (const std::exception& fault) {
        hello.fault = fault.what();
    }
    closeSandbox(options, hello.sandbox);
    constexpr auto kNever = Clock::time_point::max();
    bool open = channel.send(pack(hello), kNever) == Channel::Result::done && hello.fault.empty();
    std::string message;
    // Nothing follows a job before its answer, except an empty message that cancels it.
    if (state)
        state->isCancelled = [] {
            pollfd more{kSocket, POLLIN, 0};
            return poll(&more, 1, 0) > 0;
        };
    while (open && channel.receive(message, kNever) == Channel::Result::done) {
        if (message.empty()) continue;  // the answer was faster
        const std::string answer = work(*state, message);
        std::string().swap(message);
        open = channel.send(answer, kNever) == Channel::Result::done;
    }
    // The kernel releases all resources; Mesa's exit handlers need calls that are refused now.
    _exit(0);
}

}  // namespace farol::worker
