// Man pages, written from the table of commands in roff (man(7)).
#include <algorithm>
#include <cctype>
#include <iostream>
#include <memory>
#include <sstream>

#include "cli/command.h"
#include "cli/command_table.h"
#include "cli/messages.h"
#include "server/version.h"

namespace farol::cli {
namespace {

/// Returns the text with the syntax of roff escaped: backslashes, hyphens, dots and quotes that
/// begin a line.
std::string roff(const std::string& text) {
    std::string out;
    bool isLineStart = true;
    for (const char c : text) {
        if (isLineStart && (c == '.' || c == '\'')) out += "\\&";
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
        isLineStart = c == '\n';
    }
    return out;
}

std::string capitals(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

void writeOption(std::ostream& out, const OptionRow& option) {
    out << ".TP\n";
    std::string flags;
    for (const std::string& flag : option.flags)
        flags += (flags.empty() ? "\\fB" : ", \\fB") + roff(flag) + "\\fR";
    const std::string space = flags.empty() || option.argument.empty() ? "" : " ";
    out << flags << space
        << (option.argument.empty() ? "" : "\\fI" + roff(option.argument) + "\\fR") << "\n"
        << roff(option.help) << (option.isRequired ? " (required)" : "") << "\n";
    if (!option.variable.empty())
        out << ".br\nEnvironment: \\fB" << roff(option.variable) << "\\fR\n";
}

void writeOptions(std::ostream& out, const CommandRow& command) {
    std::vector<std::string> groups;
    for (const OptionRow& option : command.options)
        if (std::find(groups.begin(), groups.end(), option.group) == groups.end())
            groups.push_back(option.group);
    for (const std::string& group : groups) {
        out << ".SH " << (group == "Positionals" ? "ARGUMENTS" : "\"" + capitals(group) + "\"")
            << "\n";
        for (const OptionRow& option : command.options)
            if (option.group == group) writeOption(out, option);
    }
}

void writeExitStatus(std::ostream& out) {
    out << ".SH \"EXIT STATUS\"\n"
           ".TP\n\\fB0\\fR\nThe command succeeded.\n"
           ".TP\n\\fB1\\fR\nA scene, mesh or image has errors.\n"
           ".TP\n\\fB2\\fR\nThe command line has errors.\n"
           ".TP\n\\fB3\\fR\nThe program or the machine failed.\n";
}

void writeHead(std::ostream& out, const std::string& page, const std::string& summary) {
    out << ".TH " << capitals(page) << " 1 \"\" \"farol " << server::projectVersion()
        << "\" \"User Commands\"\n.SH NAME\n"
        << page << " \\- " << roff(summary) << "\n";
}

std::string commandPage(const CommandRow& command) {
    std::ostringstream out;
    writeHead(out, "farol-" + command.name, command.summary);
    out << ".SH SYNOPSIS\n\\fBfarol " << command.name << "\\fR [\\fIOPTIONS\\fR]";
    for (const OptionRow& option : command.options)
        if (option.flags.empty())
            out << (option.isRequired ? " \\fI" : " [\\fI") << roff(option.argument)
                << (option.isRequired ? "\\fR" : "\\fR]");
    out << "\n";
    writeOptions(out, command);
    writeExitStatus(out);
    out << ".SH \"SEE ALSO\"\n\\fBfarol\\fR(1)\n";
    return out.str();
}

std::string programPage(const std::vector<CommandRow>& table) {
    std::ostringstream out;
    writeHead(out, "farol", table.front().summary);
    out << ".SH SYNOPSIS\n\\fBfarol\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n.SH COMMANDS\n";
    for (std::size_t i = 1; i < table.size(); ++i)
        out << ".TP\n\\fBfarol\\-" << table[i].name << "\\fR(1)\n"
            << roff(table[i].summary) << "\n";
    writeOptions(out, table.front());
    writeExitStatus(out);
    out << ".SH FILES\n"
           ".TP\n\\fI/etc/farol/farol.toml\\fR\nSettings of the packaged service.\n"
           ".TP\n\\fI/usr/share/farol/scenes\\fR\nExample scenes.\n"
           ".TP\n\\fI/usr/share/farol/schema\\fR\nSchemas of scenes and rubrics, and the HTTP "
           "interface.\n";
    return out.str();
}

}  // namespace

void addManual(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand("man", "Prints a man page in roff")->group("");
    const auto name = std::make_shared<std::string>();
    command->add_option("COMMAND", *name, "a subcommand; default the program itself");
    const auto isList = std::make_shared<bool>(false);
    command->add_flag("--list", *isList, "names of the subcommands, a line each");
    command->callback([&root, &action, name, isList] {
        action = [&root, name, isList](Report&) {
            const std::vector<CommandRow> table = commandTable(root);
            if (*isList) {
                for (std::size_t i = 1; i < table.size(); ++i) std::cout << table[i].name << "\n";
                return kDone;
            }
            if (name->empty()) {
                std::cout << programPage(table) << std::flush;
                return kDone;
            }
            for (std::size_t i = 1; i < table.size(); ++i) {
                if (table[i].name != *name) continue;
                std::cout << commandPage(table[i]) << std::flush;
                return kDone;
            }
            throw UsageError(message<"usage/manual">("name"_arg = *name));
        };
    });
}

}  // namespace farol::cli
