#include "server/version.h"

#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/confine.h"
#include "core/text.h"
#include "image/animation.h"
#include "render/renderer.h"

namespace farol::cli {

std::string versionLine(render::GlSource source) {
    return "farol " + server::projectVersion() + "\nrenderer: " + render::version(source);
}

void addVersion(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand("version", "Says what was built and what draws");
    const auto source = std::make_shared<render::GlSource>();
    addGlSource(*command, *source);
    command->callback([&action, source] {
        action = [source](Report& report) {
            // In the sandbox of the other commands, to report its layers.
            return confine({}, report, [&report, source](Outputs& outputs) {
                report.set("version", server::projectVersion());
                report.set("renderer", render::version(*source));
                nlohmann::json layers = nlohmann::json::object();
                for (const auto& [name, state] : outputs.layers()) layers[name] = state;
                const std::string sandbox = joined(outputs.layers(), ", ", [](const auto& layer) {
                    return layer.first + " " + layer.second;
                });
                report.set("sandbox", layers);
                const std::vector<std::string> animations = image::writableAnimations();
                report.set("animations", animations);
                if (!report.json())
                    std::cout << versionLine(*source) << "\nsandbox: " << sandbox
                              << "\nanimations: " << joined(animations, ", ") << std::endl;
                return kDone;
            });
        };
    });
}

}  // namespace farol::cli
