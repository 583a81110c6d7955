// Completions for shells: each is a program of that shell, written from the table of commands.
#include <iostream>
#include <memory>
#include <sstream>

#include "cli/command.h"
#include "cli/command_table.h"

namespace farol::cli {
namespace {

std::string spaced(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
}

/// Returns the text as a word of a shell, in single quotes.
std::string shellQuoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::vector<std::string> subcommandNames(const std::vector<CommandRow>& table) {
    std::vector<std::string> names;
    for (std::size_t i = 1; i < table.size(); ++i) names.push_back(table[i].name);
    return names;
}

std::vector<std::string> flagsOf(const CommandRow& command) {
    std::vector<std::string> flags;
    for (const OptionRow& option : command.options)
        flags.insert(flags.end(), option.flags.begin(), option.flags.end());
    return flags;
}

std::string bashCompletion(const std::vector<CommandRow>& table) {
    std::ostringstream out;
    out << "# bash completion for farol: source it, or install it as farol in bash-completion's "
           "folder.\n"
           "_farol() {\n"
           "    local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]:-} words=\n"
           "    if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
           "        words="
        << shellQuoted(spaced(subcommandNames(table)) + " " + spaced(flagsOf(table.front())))
        << "\n"
           "    else\n"
           "        case $command:${COMP_WORDS[COMP_CWORD - 1]} in\n";
    for (const CommandRow& command : table)
        for (const OptionRow& option : command.options)
            if (!option.choices.empty())
                for (const std::string& flag : option.flags)
                    out << "            " << command.name << ':' << flag
                        << ") words=" << shellQuoted(spaced(option.choices)) << " ;;\n";
    out << "            *) [[ $word != -* ]] || case $command in\n";
    for (std::size_t i = 1; i < table.size(); ++i)
        out << "                " << table[i].name
            << ") words=" << shellQuoted(spaced(flagsOf(table[i]))) << " ;;\n";
    out << "                esac ;;\n"
           "        esac\n"
           "    fi\n"
           "    COMPREPLY=()\n"
           "    [ -z \"$words\" ] || mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
           "}\n"
           "complete -o default -F _farol farol\n";
    return out.str();
}

/// Returns the text for zsh's _arguments, where brackets, colons and backslashes are syntax.
std::string zshText(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '[' || c == ']' || c == ':' || c == '\\') out += '\\';
        out += c;
    }
    return out;
}

std::string zshCompletion(const std::vector<CommandRow>& table) {
    std::ostringstream out;
    out << "#compdef farol\n"
           "_farol() {\n"
           "    local -a commands=(\n";
    for (std::size_t i = 1; i < table.size(); ++i)
        out << "        " << shellQuoted(table[i].name + ":" + zshText(table[i].summary)) << "\n";
    out << "    )\n"
           "    if ((CURRENT == 2)); then\n"
           "        _describe command commands\n"
           "        return\n"
           "    fi\n"
           "    shift words\n"
           "    ((CURRENT--))\n"
           "    case $words[1] in\n";
    for (std::size_t i = 1; i < table.size(); ++i) {
        out << "        " << table[i].name << ") _arguments";
        for (const OptionRow& option : table[i].options) {
            for (const std::string& flag : option.flags) {
                std::string text = flag + "[" + zshText(option.help) + "]";
                if (!option.choices.empty())
                    text += ":" + zshText(option.argument) + ":(" + spaced(option.choices) + ")";
                else if (!option.argument.empty())
                    text += ":" + zshText(option.argument) + ":_files";
                out << " \\\n            " << shellQuoted(text);
            }
        }
        out << " \\\n            '*:file:_files' ;;\n";
    }
    out << "    esac\n"
           "}\n"
           "_farol \"$@\"\n";
    return out.str();
}

std::string fishCompletion(const std::vector<CommandRow>& table) {
    std::ostringstream out;
    out << "# fish completion for farol.\n";
    for (std::size_t i = 1; i < table.size(); ++i)
        out << "complete -c farol -n __fish_use_subcommand -f -a " << table[i].name << " -d "
            << shellQuoted(table[i].summary) << "\n";
    for (std::size_t i = 1; i < table.size(); ++i) {
        for (const OptionRow& option : table[i].options) {
            if (option.flags.empty()) continue;
            out << "complete -c farol -n '__fish_seen_subcommand_from " << table[i].name << "'";
            for (const std::string& flag : option.flags)
                out << (flag.starts_with("--") ? " -l " + flag.substr(2) : " -s " + flag.substr(1));
            if (!option.choices.empty())
                out << " -x -a " << shellQuoted(spaced(option.choices));
            else if (!option.argument.empty())
                out << " -r";
            out << " -d " << shellQuoted(option.help) << "\n";
        }
    }
    return out.str();
}

}  // namespace

void addCompletion(CLI::App& root, Action& action) {
    CLI::App* command =
        root.add_subcommand("completion", "Prints the completions of a shell: bash, zsh or fish");
    const auto shell = std::make_shared<std::string>();
    command->add_option("SHELL", *shell, "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh", "fish"}));
    command->callback([&root, &action, shell] {
        action = [&root, shell](Report& report) {
            const std::vector<CommandRow> table = commandTable(root);
            const std::string text = *shell == "bash"  ? bashCompletion(table)
                                     : *shell == "zsh" ? zshCompletion(table)
                                                       : fishCompletion(table);
            if (report.json())
                report.set("completion", text);
            else
                std::cout << text << std::flush;
            return kDone;
        };
    });
}

}  // namespace farol::cli
