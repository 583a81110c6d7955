#include <algorithm>
#include <exception>
#include <string_view>

#include "cli/command.h"
#include "cli/files.h"
#include "scene/text.h"
#include "scene/words.h"

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

/// Whatever is not an option of `command`, with the nearest that is.
std::string unexpected(const CLI::App& command, const std::string& word) {
    std::vector<std::string> known;
    for (const CLI::Option* one : command.get_options())
        for (const std::string& name : one->get_lnames()) known.push_back("--" + name);
    const std::string given = word.substr(0, word.find('='));
    const std::string near = word[0] == '-' ? scene::didYouMean(given, known) : "";
    return command.get_name() + (word[0] == '-' ? " has no option " : " does not expect ") +
           scene::quoted(given) + (near.empty() ? "" : "; did you mean " + near + "?");
}

/// What CLI11 says, where it can be said better.
std::string usageFault(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
    const auto commands = app.get_subcommands();
    if (commands.empty() && argc > 1) {
        std::vector<std::string> names;
        for (const CLI::App* one : app.get_subcommands([](const CLI::App*) { return true; }))
            if (!one->get_group().empty()) names.push_back(one->get_name());
        const std::string near = scene::didYouMean(argv[1], names);
        std::string list;
        for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
        return "there is no subcommand " + scene::quoted(argv[1]) +
               (near.empty() ? " among " + list : "; did you mean \"" + near + "\"?");
    }
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ExtrasError) &&
        !commands.empty()) {
        const auto extras = commands.front()->remaining();
        const auto option = std::find_if(extras.begin(), extras.end(), [](const std::string& one) {
            return !one.empty() && one[0] == '-';
        });
        if (!extras.empty())
            return unexpected(*commands.front(), option == extras.end() ? extras.front() : *option);
    }
    return error.what();
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
        const auto commands = app.get_subcommands();
        const std::string help = commands.empty() ? "farol" : "farol " + commands[0]->get_name();
        report.fail("usage",
                    usageFault(app, error, argc, argv) + " (" + help + " --help says more)");
        report.finish(kUsage);
        return kUsage;
    }
    const int status = run(action, report);
    report.finish(status);
    return status;
}
