#include "worker/worker.h"

#include <memory>

#include "cli/command.h"

namespace farol::cli {

void addWorker(CLI::App& root, Action& action) {
    // An empty group keeps it out of the help.
    CLI::App* command =
        root.add_subcommand("worker", "What serve starts: not for the hand")->group("");
    struct Told {
        worker::SandboxOptions sandbox;
        double maxCost = 0.0;
        std::string probe;
        bool asCommandLine = false;
    };
    const auto told = std::make_shared<Told>();
    command->add_option("--scenes", told->sandbox.readable, "folder that may be read");
    command->add_option("--memory", told->sandbox.memoryBytes, "private memory, bytes; 0: no cap");
    command->add_option("--max-cost", told->maxCost, "of one job, core-seconds; 0: no bound");
    command->add_option("--self-test", told->probe,
                        "a file to try the sandbox on: says what it lets through");
    command->add_flag("--command-line", told->asCommandLine,
                      "with --self-test: the sandbox of render, compare, validate and generate");
    command->callback([&action, told] {
        action = [told](Report&) {
            return told->probe.empty()
                       ? worker::runWorker(told->sandbox, told->maxCost)
                       : worker::runSelfTest(told->sandbox, told->probe, told->asCommandLine);
        };
    });
}

}  // namespace farol::cli
