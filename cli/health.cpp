#include "server/http/health.h"

#include <iostream>
#include <memory>

#include "cli/command.h"
#include "cli/messages.h"

namespace farol::cli {
namespace {

struct Flags {
    std::string url = "http://127.0.0.1:8080";
    double timeoutS = 5.0;
};

int run(const Flags& flags, Report& report) {
    const std::chrono::milliseconds patience(static_cast<std::int64_t>(flags.timeoutS * 1000.0));
    const server::http::Health health = server::http::askHealth(flags.url, patience);
    report.set("url", flags.url);
    report.set("ready", health.ready);
    report.set("answer", health.reason);
    if (!health.ready) {
        report.fail(message<"service.unready">("url"_arg = uncut(flags.url),
                                               "reason"_arg = uncut(health.reason)));
        return kInputFault;
    }
    if (!report.json()) std::cout << flags.url << ": ready" << std::endl;
    return kDone;
}

}  // namespace

void addHealth(CLI::App& root, Action& action) {
    CLI::App* command =
        root.add_subcommand("health", "Asks a service whether it is ready; exit code 0 if so");
    const auto flags = std::make_shared<Flags>();
    command->add_option("URL", flags->url, "of the service, http://host:port")
        ->type_name("")
        ->capture_default_str();
    takesNumber(command->add_option("--timeout", flags->timeoutS, "how long to wait for it, s"),
                0.001, 600.0);
    command->callback(
        [&action, flags] { action = [flags](Report& report) { return run(*flags, report); }; });
}

}  // namespace farol::cli
