#include "cli/command_table.h"

#include <algorithm>

namespace farol::cli {
namespace {

bool isWord(const std::string& text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
    });
}

/// Returns the words of "png|jpeg|webp"; none for placeholders such as "WxH+X+Y|auto".
std::vector<std::string> choicesOf(const std::string& argument) {
    if (argument.find('|') == std::string::npos) return {};
    std::vector<std::string> words;
    const std::string list = argument.substr(0, argument.find(' '));  // "1|2|4 samples"
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find('|', begin), list.size());
        words.push_back(list.substr(begin, end - begin));
        if (!isWord(words.back())) return {};
        begin = end + 1;
    }
    return words;
}

OptionRow rowOf(const CLI::Option& option) {
    OptionRow row;
    for (const std::string& name : option.get_snames()) row.flags.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) row.flags.push_back("--" + name);
    const bool isFlag = option.get_type_size() == 0;
    row.argument = row.flags.empty() ? option.get_name() : isFlag ? "" : option.get_type_name();
    row.argument = row.argument.substr(0, row.argument.find(":{"));  // of CLI::IsMember
    row.choices = choicesOf(row.argument);
    row.help = option.get_description();
    row.group = option.get_group();
    row.variable = option.get_envname();
    row.isRequired = option.get_required();
    return row;
}

CommandRow rowOf(const CLI::App& command) {
    CommandRow row{command.get_name(), command.get_description(), {}};
    for (const CLI::Option* option : command.get_options())
        if (!option->get_group().empty()) row.options.push_back(rowOf(*option));
    return row;
}

}  // namespace

std::vector<CommandRow> commandTable(const CLI::App& root) {
    std::vector<CommandRow> rows{rowOf(root)};
    for (const CLI::App* command : root.get_subcommands([](const CLI::App*) { return true; }))
        if (!command->get_group().empty()) rows.push_back(rowOf(*command));
    return rows;
}

}  // namespace farol::cli
