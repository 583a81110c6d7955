#include "server/worker/worker.h"

#include <signal.h>
#include <unistd.h>

#include <memory>

#include "server/worker/channel.h"
#include "server/worker/jobs.h"

namespace farol::server::worker {

int runWorker(const SandboxOptions& options) {
    // ^C and a service manager's SIGTERM reach the whole group; the parent decides when we end.
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) signal(number, SIG_IGN);
    Channel channel(kSocket);
    Hello hello;
    enterSandbox(options, hello.sandbox);
    std::unique_ptr<render::Renderer> renderer;
    std::unique_ptr<grade::Grader> grader;
    try {
        renderer = std::make_unique<render::Renderer>();
        warmUp(*renderer);
        grader = std::make_unique<grade::Grader>(*renderer);
        hello.gl = renderer->gl();
    } catch (const std::exception& fault) {
        hello.fault = fault.what();
    }
    closeSandbox(options, hello.sandbox);
    constexpr auto kNever = Clock::time_point::max();
    bool open = channel.send(pack(hello), kNever) == Channel::Result::done && hello.fault.empty();
    std::string message;
    while (open && channel.receive(message, kNever) == Channel::Result::done) {
        Reply reply;
        try {
            reply = work(*renderer, *grader, unpackRequest(message));
        } catch (const std::bad_alloc&) {
            reply.outcome = Outcome::memory;
        } catch (const std::exception& fault) {
            reply.outcome = Outcome::broken;
            reply.message = fault.what();
        }
        std::string().swap(message);
        open = channel.send(pack(reply), kNever) == Channel::Result::done;
    }
    // Nothing to tidy up that the kernel does not; Mesa's own end would want what is closed now.
    _exit(0);
}

}  // namespace farol::server::worker
