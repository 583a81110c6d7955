#include "scene/repair/repair.h"

#include <algorithm>
#include <iterator>

#include "core/number.h"
#include "core/text.h"
#include "scene/messages.h"
#include "scene/repair/scanner.h"

namespace farol::scene {

LineIndex::LineIndex(std::string_view text, std::string file) : file_(std::move(file)) {
    starts_.push_back(text.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0);
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool aloneReturn = text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n');
        if (text[i] == '\n' || aloneReturn) starts_.push_back(i + 1);
    }
}

Location LineIndex::at(std::size_t offset) const {
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), offset);
    const auto line = std::max<std::ptrdiff_t>(after - starts_.begin(), 1);
    const std::size_t start = starts_[static_cast<std::size_t>(line - 1)];
    const std::size_t column = offset >= start ? offset - start + 1 : 1;
    return {file_, static_cast<int>(line), static_cast<int>(column)};
}

std::size_t Repaired::origin(std::size_t offset) const {
    auto after = std::upper_bound(
        origins.begin(), origins.end(), offset,
        [](std::size_t wanted, const auto& entry) { return wanted < entry.first; });
    if (after == origins.begin()) return 0;
    --after;
    return after->second + (offset - after->first);
}

namespace {

/// Removes the quotes round a file name or a whole command.
std::string_view unquoted(std::string_view word) {
    constexpr std::string_view kQuotes = "\"'`";
    while (!word.empty() && kQuotes.find(word.front()) != std::string_view::npos)
        word.remove_prefix(1);
    while (!word.empty() && (kQuotes.find(word.back()) != std::string_view::npos ||
                             word.back() == ',' || word.back() == ')'))
        word.remove_suffix(1);
    return word;
}

bool isGenerator(std::string_view word) {
    std::string program = lowerCase(baseName(unquoted(word)));
    if (program.size() > 4 && program.substr(program.size() - 4) == ".exe")
        program.resize(program.size() - 4);
    if (program.ends_with(".py")) program.resize(program.size() - 3);
    static constexpr std::string_view kNames[] = {"generator", "generate", "gerador", "generador",
                                                  "gen"};
    return std::find(std::begin(kNames), std::end(kNames), program) != std::end(kNames);
}

bool isNumber(std::string_view word) { return parseNumber(word).problem.empty(); }

/// Where the command begins: at the first word, or after a prompt or a label ("$", "run:"); prose
/// that speaks of a generator names no numbers and no file.
std::size_t commandAt(const std::vector<std::string_view>& words) {
    constexpr std::size_t kMaxLabelWords = 3;  ///< words
    for (std::size_t i = 0; i < words.size() && i <= kMaxLabelWords; ++i) {
        if (!isGenerator(words[i])) continue;
        const bool numbers =
            std::any_of(words.begin() + static_cast<std::ptrdiff_t>(i), words.end(), isNumber);
        const bool file = words.back().find('.') != std::string_view::npos;
        return i == 0 || (numbers && file) ? i : words.size();
    }
    return words.size();
}

bool endsCommand(std::string_view word) {
    while (!word.empty() &&
           std::string_view("\"'`,;).").find(word.back()) != std::string_view::npos)
        word.remove_suffix(1);
    return fileEnding(word) == "3d";
}

/// One command of a comment; see takeGeneratorWords.
bool takeCommand(std::string_view line, std::map<std::string, std::vector<std::string>>& comments,
                 bool& conflict) {
    constexpr std::size_t kMaxWords = 32, kMaxLineBytes = 1024;
    if (line.size() > kMaxLineBytes) return false;
    std::vector<std::string_view> words = split(line);
    // Before the file: "generator sphere 1 8 8 > ball.3d", "-o ball.3d".
    if (words.size() > 1 && (words.end()[-2] == ">" || words.end()[-2] == "-o"))
        words.erase(words.end() - 2);
    const std::size_t begin = commandAt(words);
    if (words.size() < begin + 3 || words.size() > begin + kMaxWords) return false;
    const std::string file(baseName(unquoted(words.back())));
    if (file.empty()) return false;
    std::vector<std::string> arguments;
    for (std::size_t i = begin + 1; i + 1 < words.size(); ++i)
        arguments.emplace_back(unquoted(words[i]));
    const auto [entry, isNew] = comments.emplace(file, arguments);
    conflict = conflict || (!isNew && entry->second != arguments);
    return true;
}

/// The commands of one line: each ends at its .3d, and but for the first may leave "generator" out.
bool takeLine(std::string_view line, std::map<std::string, std::vector<std::string>>& comments,
              bool& conflict) {
    // More markup in it: something was commented out, or the comment swallowed its neighbours.
    const std::size_t mark = line.find_first_of("<>");
    const bool isRedirect = mark != std::string_view::npos && mark > 0 &&
                            line.substr(mark - 1, 3) == " > " &&
                            line.find_first_of("<>", mark + 1) == std::string_view::npos;
    if ((mark != std::string_view::npos && !isRedirect) ||
        line.find("--") != std::string_view::npos)
        return false;
    bool any = false;
    std::size_t begin = 0, at = 0;
    while (at < line.size()) {
        while (at < line.size() && isBlank(line[at])) ++at;
        const std::size_t word = at;
        while (at < line.size() && !isBlank(line[at])) ++at;
        if (at < line.size() && !endsCommand(line.substr(word, at - word))) continue;
        const std::string_view command = trimmed(line.substr(begin, at - begin));
        if (takeCommand(command, comments, conflict))
            any = true;
        else if (any && endsCommand(command))
            takeCommand("generator " + std::string(command), comments, conflict);
        begin = at;
    }
    return any;
}

}  // namespace

bool takeGeneratorWords(std::string_view comment,
                        std::map<std::string, std::vector<std::string>>& comments, bool& conflict) {
    conflict = false;
    comment = trimmed(comment);
    while (!comment.empty() && comment.back() == '-') comment.remove_suffix(1);  // "--->"
    bool any = false;
    while (!comment.empty()) {
        const std::size_t end = std::min(comment.find_first_of("\n\r;"), comment.size());
        any = takeLine(trimmed(comment.substr(0, end)), comments, conflict) || any;
        comment.remove_prefix(std::min(end + 1, comment.size()));
    }
    return any;
}

namespace {

/// Names the type of a binary file by its first bytes; empty for any other file.
std::string_view kindOfBinary(std::string_view bytes) {
    struct Kind {
        std::string_view start, name;
    };
    static constexpr Kind kKinds[] = {{"\xFD"
                                       "7zXZ",
                                       "a .tar.xz archive"},
                                      {"BZh", "a .tar.bz2 archive"},
                                      {"\x28\xB5\x2F\xFD", "a .tar.zst archive"},
                                      {"\x89PNG", "an image"},
                                      {"\xFF\xD8\xFF", "an image"},
                                      {"GIF8", "an image"},
                                      {"BM", "an image"},
                                      {"%PDF-", "a PDF document"},
                                      {"MZ", "a program"},
                                      {"\x7F"
                                       "ELF",
                                       "a program"},
                                      {"BLENDER", "a Blender file"},
                                      {"Kaydara FBX", "an FBX file"}};
    for (const Kind& kind : kKinds)
        if (bytes.starts_with(kind.start)) return kind.name;
    return "";
}

/// Blanks the lines of merge conflicts but for the first version of each; offsets stay. Warns.
std::string withoutConflicts(std::string_view source, const LineIndex& lines, Findings& findings) {
    std::string out(source);
    enum class Part { none, first, other } part = Part::none;
    for (std::size_t begin = 0; begin < source.size();) {
        const std::size_t end = std::min(source.find('\n', begin), source.size());
        const std::string_view line = source.substr(begin, end - begin);
        const Part before = part;
        if (line.starts_with("<<<<<<<") && part == Part::none &&
            source.find("\n=======", end) != std::string_view::npos) {
            findings.warn(message<"xml.conflict">("line"_arg = lines.at(begin).line + 1),
                          lines.at(begin));
            part = Part::first;
        } else if (part == Part::first &&
                   (line.starts_with("|||||||") || line.starts_with("======="))) {
            part = Part::other;
        } else if (part == Part::other && line.starts_with(">>>>>>>")) {
            part = Part::none;
        }
        if (part != before || part == Part::other)
            std::fill(out.begin() + static_cast<std::ptrdiff_t>(begin),
                      out.begin() + static_cast<std::ptrdiff_t>(end), ' ');
        begin = end + 1;
    }
    return out;
}

}  // namespace

Repaired repair(std::string_view source, const LineIndex& lines, const ReadLimits& limits,
                Findings& findings) {
    if (source.size() > limits.bytes)
        throw Error(message<"limit.bytes">("bytes"_arg = source.size(), "max"_arg = limits.bytes),
                    lines.at(0));
    if (trimmed(source).empty() || trimmed(source) == "\xEF\xBB\xBF")
        throw Error(message<"xml.empty">(), lines.at(0));
    // Some programs write the rest of a buffer, too.
    while (source.ends_with('\0')) source.remove_suffix(1);
    const std::size_t nul = source.find('\0');
    if (const std::string_view kind = kindOfBinary(source);
        nul != std::string_view::npos && !kind.empty())
        throw Error(message<"xml.character/kind">("kind"_arg = kind), lines.at(0));
    if (nul != std::string_view::npos) throw Error(message<"xml.character/nul">(), lines.at(nul));
    if (source.find("<<<<<<<") == std::string_view::npos)
        return RepairScanner(source, lines, limits, findings).run();
    const std::string merged = withoutConflicts(source, lines, findings);
    return RepairScanner(merged, lines, limits, findings).run();
}

}  // namespace farol::scene
