#include "server/worker/worker.h"

#include <memory>

#include "cli/command.h"

namespace farol::cli {

void addWorker(CLI::App& root, Action& action) {
    // An empty group keeps it out of the help.
    CLI::App* command =
        root.add_subcommand("worker", "What serve starts: not for the hand")->group("");
    struct Told {
        server::worker::SandboxOptions sandbox;
        std::string probe;
    };
    const auto told = std::make_shared<Told>();
    command->add_option("--scenes", told->sandbox.readable, "folder that may be read");
    command->add_option("--memory", told->sandbox.memoryBytes, "private memory, bytes; 0: no cap");
    command->add_option("--self-test", told->probe,
                        "a file to try the sandbox on: says what it lets through");
    command->callback([&action, told] {
        action = [told](Report&) {
            return told->probe.empty() ? server::worker::runWorker(told->sandbox)
                                       : server::worker::runSelfTest(told->sandbox, told->probe);
        };
    });
}

}  // namespace farol::cli
