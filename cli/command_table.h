#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

/// The subcommands and their options as plain values, from which man pages and completions are
/// written.
namespace farol::cli {

struct OptionRow {
    std::vector<std::string> flags;    ///< "-o", "--output"; empty: a positional argument
    std::string argument;              ///< its placeholder, "FILE" or "1..64"; empty: none
    std::vector<std::string> choices;  ///< where the argument is one of a few words
    std::string help;
    std::string group;     ///< the heading that it is listed under
    std::string variable;  ///< of the environment; empty: none
    bool isRequired = false;
};

struct CommandRow {
    std::string name;  ///< "render"; of the program itself "farol"
    std::string summary;
    std::vector<OptionRow> options;
};

/// Returns the program's own options, then each subcommand that its help lists, in that order.
std::vector<CommandRow> commandTable(const CLI::App& root);

}  // namespace farol::cli
