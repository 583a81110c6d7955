#include "worker/worker.h"

#include <memory>

#include "cli/command.h"

namespace farol::cli {

void addWorker(CLI::App& root, Action& action) {
    // An empty group keeps it out of the help.
    CLI::App* command =
        root.add_subcommand("worker", "What serve starts: not for the hand")->group("");
    struct WorkerFlags {
        worker::SandboxOptions sandbox;
        double maxCost = 0.0;
        render::GlSource gl = render::GlSource::automatic;
        std::string probe;
        bool asCommandLine = false;
    };
    const auto flags = std::make_shared<WorkerFlags>();
    command->add_option("--scenes", flags->sandbox.readable, "folder that may be read");
    command->add_option("--memory", flags->sandbox.memoryBytes, "private memory, bytes; 0: no cap");
    command->add_option("--max-cost", flags->maxCost, "of one job, core-seconds; 0: no bound");
    addGlSource(*command, flags->gl);
    command->add_option("--self-test", flags->probe,
                        "a file to try the sandbox on: says what it lets through");
    command->add_flag("--command-line", flags->asCommandLine,
                      "with --self-test: the sandbox of render, compare, validate and generate");
    command->callback([&action, flags] {
        action = [flags](Report&) {
            return flags->probe.empty()
                       ? worker::runWorker(flags->sandbox, flags->maxCost, flags->gl)
                       : worker::runSelfTest(flags->sandbox, flags->probe, flags->asCommandLine);
        };
    });
}

}  // namespace farol::cli
