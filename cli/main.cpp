#include <algorithm>
#include <string_view>

#include "cli/command.h"
#include "cli/descriptors.h"
#include "cli/messages.h"
#include "core/did_you_mean.h"
#include "core/text.h"

namespace {

using namespace farol;
using namespace farol::cli;

constexpr const char* kFooter = R"(
Exit codes: 0 done; 1 the input is at fault; 2 the command line is; 3 the program or the machine is.
Diagnostics go to stderr as file:line:column: severity: message [code].)";

/// Reports a word that is neither an option nor an argument of `command`.
Message unexpected(const CLI::App& command, const std::string& word) {
    std::vector<std::string> known;
    for (const CLI::Option* one : command.get_options())
        for (const std::string& name : one->get_lnames()) known.push_back("--" + name);
    if (word[0] != '-')
        return message<"usage/word">("command"_arg = command.get_name(), "word"_arg = word);
    const std::string option = word.substr(0, word.find('='));
    return message<"usage/option">("command"_arg = command.get_name(), "option"_arg = option,
                                   "suggestion"_arg = didYouMean(option, known));
}

/// Returns the parser's message, or a more exact one where there is one.
Message usageFault(const CLI::App& app, const CLI::ParseError& error, int argc, char** argv) {
    const auto commands = app.get_subcommands();
    if (commands.empty() && argc > 1) {
        std::vector<std::string> names;
        for (const CLI::App* one : app.get_subcommands([](const CLI::App*) { return true; }))
            if (!one->get_group().empty()) names.push_back(one->get_name());
        const std::string near = didYouMean(argv[1], names);
        return message<"usage/subcommand">(
            "name"_arg = argv[1], "suggestion"_arg = near,
            "known"_arg = uncut(near.empty() ? joined(names, ", ") : ""));
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
    const std::string command = commands.empty() ? "farol" : "farol " + commands[0]->get_name();
    return message<"usage/arguments">("reason"_arg = uncut(error.what()), "command"_arg = command);
}

}  // namespace

int main(int argc, char** argv) {
    if (!holdStandardDescriptors()) return kInternal;
    CLI::App app("Farol renders XML scenes without a screen.", "farol");
    app.footer(kFooter);
    app.require_subcommand(1);
    app.set_version_flag("--version", [] { return versionLine(); });
    Report report;
    Action action;
    addRender(app, action);
    addServe(app, action);
    addGenerate(app, action);
    addConvert(app, action);
    addValidate(app, action);
    addCompare(app, action);
    addGrade(app, action);
    addExplain(app, action);
    addSchema(app, action);
    addHealth(app, action);
    addVersion(app, action);
    addCompletion(app, action);
    addManual(app, action);
    addWorker(app, action);
    for (const char* name :
         {"validate", "render", "generate", "convert", "compare", "explain", "grade"})
        addLanguage(*app.get_subcommand(name), report);
    for (CLI::App* command : app.get_subcommands({}))
        if (command->get_option_no_throw("--json") == nullptr)  // of schema it is a form
            command->add_flag_callback(
                "--json", [&report] { report.useJson(); },
                "say everything as one JSON object on stdout");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);  // --help and --version
        // A flag before the fault may not have been read yet.
        for (int i = 1; i < argc; ++i) {
            if (std::string_view(argv[i]) == "--json") report.useJson();
            if (std::string_view(argv[i]) != "--lang" || i + 1 == argc) continue;
            if (const auto language = kLanguageWords.find(argv[i + 1]))
                report.setLanguage(*language);
        }
        report.fail(usageFault(app, error, argc, argv));
        report.finish(kUsage);
        return kUsage;
    }
    const int status = runGuarded([&] { return action(report); }, report);
    report.finish(status);
    return status;
}
