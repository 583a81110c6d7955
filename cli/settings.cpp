#include "cli/settings.h"

#include <algorithm>
#include <cctype>
#include <string>

namespace farol::cli {
namespace {

constexpr const char* kFileFlag = "--config";

bool isSetting(const CLI::Option& option) {
    const std::string name = option.get_name();
    return name.starts_with("--") && name != "--help" && name != "--json";
}

void set(CLI::App& command, const std::string& file, const CLI::ConfigItem& item) {
    const auto fault = [&](const std::string& what) {
        return CLI::ConfigError(file + ": " + item.fullname() + ": " + what,
                                CLI::ExitCodes::ConfigError);
    };
    if (!item.parents.empty()) throw fault("sections are not used here: only name = value");
    CLI::Option* option = command.get_option_no_throw("--" + item.name);
    if (option == nullptr || !isSetting(*option) || option->get_name() == kFileFlag)
        throw fault("there is no such setting");
    if (option->count() > 0) return;  // by a flag, or by the environment
    if (item.inputs.size() != 1) throw fault("one value is expected");
    const std::string& value = item.inputs.front();
    const bool isFlag = option->get_expected_max() == 0;
    if (isFlag && value == "false") return;
    if (isFlag && value != "true") throw fault("true or false is expected");
    try {
        option->add_result(value);
        option->run_callback();
    } catch (const CLI::ParseError& error) {
        throw fault(error.what());
    }
}

}  // namespace

std::string variableOf(const std::string& flag) {
    std::string name = "FAROL_";
    for (const char c : flag.substr(2))
        name += c == '-' ? '_' : static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return name;
}

void addSettings(CLI::App& command) {
    command.add_option(kFileFlag, "a TOML file of these settings, without the dashes: port = 8080")
        ->type_name("FILE");
    for (CLI::Option* option : command.get_options())
        if (isSetting(*option)) option->envname(variableOf(option->get_name()));
}

void readSettings(CLI::App& command) {
    const CLI::Option* named = command.get_option(kFileFlag);
    if (named->count() == 0) return;
    const auto file = named->as<std::string>();
    std::vector<CLI::ConfigItem> items;
    try {
        items = CLI::ConfigTOML().from_file(file);
    } catch (const CLI::Error& error) {
        throw CLI::ConfigError(file + ": " + error.what(), CLI::ExitCodes::ConfigError);
    }
    for (const CLI::ConfigItem& item : items) set(command, file, item);
}

}  // namespace farol::cli
