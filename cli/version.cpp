#include "server/version.h"

#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/confine.h"
#include "core/text.h"
#include "render/renderer.h"

namespace farol::cli {

std::string versionLine() {
    return "farol " + server::projectVersion() + "\nrenderer: " + render::version();
}

void addVersion(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand("version", "Says what was built and what draws");
    command->callback([&action] {
        action = [](Report& report) {
            // Closed in as the commands are, so that the layers are those that they get.
            return confine({}, report, [&report](Outputs& outputs) {
                report.set("version", server::projectVersion());
                report.set("renderer", render::version());
                nlohmann::json layers = nlohmann::json::object();
                for (const auto& [name, state] : outputs.layers()) layers[name] = state;
                const std::string sandbox = joined(outputs.layers(), ", ", [](const auto& layer) {
                    return layer.first + " " + layer.second;
                });
                report.set("sandbox", layers);
                if (!report.json())
                    std::cout << versionLine() << "\nsandbox: " << sandbox << std::endl;
                return kDone;
            });
        };
    });
}

}  // namespace farol::cli
