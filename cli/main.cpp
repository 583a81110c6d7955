#include <exception>
#include <string_view>

#include "cli/command.h"
#include "cli/files.h"

namespace {

using namespace farol;
using namespace farol::cli;

constexpr const char* kFooter = R"(
Exit codes: 0 done; 1 the input is at fault; 2 the command line is; 3 the program or the machine is.
Diagnostics go to stderr as file:line:column: severity: message [code].)";

int run(const Action& action, Report& report) {
    try {
        return action(report);
    } catch (const UsageError& error) {
        report.fail(error.code(), error.what());
        return kUsage;
    } catch (const Error& error) {
        report.add(error.diagnostics());
        return error.code().rfind("option.", 0) == 0 ? kUsage : kInputFault;
    } catch (const OutputError& error) {
        report.fail("output.unwritable", error.what());
        return kInternal;
    } catch (const std::exception& error) {
        report.fail("internal", error.what());
        return kInternal;
    }
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Farol renders XML scenes without a screen.", "farol");
    app.footer(kFooter);
    app.require_subcommand(1);
    app.set_version_flag("--version", versionLine);
    Report report;
    Action action;
    addRender(app, action);
    addServe(app, action);
    addGenerate(app, action);
    addValidate(app, action);
    addCompare(app, action);
    addGrade(app, action);
    addHealth(app, action);
    addVersion(app, action);
    addWorker(app, action);
    for (CLI::App* command : app.get_subcommands({}))
        command->add_flag_callback(
            "--json", [&report] { report.useJson(); },
            "say everything as one JSON object on stdout");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version
        // A flag before the fault may not have been read yet.
        for (int i = 1; i < argc; ++i)
            if (std::string_view(argv[i]) == "--json") report.useJson();
        report.fail("usage", std::string(error.what()) + " (farol --help says more)");
        report.finish(kUsage);
        return kUsage;
    }
    const int status = run(action, report);
    report.finish(status);
    return status;
}
