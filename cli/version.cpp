#include "server/version.h"

#include <iostream>
#include <memory>

#include "cli/command.h"
#include "render/renderer.h"

namespace farol::cli {

std::string versionLine() {
    return "farol " + server::projectVersion() + "\nrenderer: " + render::version();
}

void addVersion(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand("version", "Says what was built and what draws");
    command->callback([&action] {
        action = [](Report& report) {
            report.set("version", server::projectVersion());
            report.set("renderer", render::version());
            if (!report.json()) std::cout << versionLine() << std::endl;
            return kDone;
        };
    });
}

}  // namespace farol::cli
