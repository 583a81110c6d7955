#include "scene/repair.h"

#include <algorithm>

#include "scene/repair_scanner.h"
#include "scene/words.h"

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

bool takeGeneratorWords(std::string_view comment,
                        std::map<std::string, std::vector<std::string>>& comments, bool& conflict) {
    constexpr std::size_t kMaxWords = 32;
    conflict = false;
    comment = trimmed(comment);
    while (!comment.empty() && comment.back() == '-') comment.remove_suffix(1);  // "--->"
    // More markup in it: something was commented out, or the comment swallowed its neighbours.
    if (comment.size() > 1024 || comment.find_first_of("<>") != std::string_view::npos ||
        comment.find("--") != std::string_view::npos)
        return false;
    const std::vector<std::string_view> words = split(comment);
    if (words.size() < 3 || words.size() > kMaxWords) return false;
    std::string program = lowerCase(baseName(words.front()));
    if (program.size() > 4 && program.substr(program.size() - 4) == ".exe")
        program.resize(program.size() - 4);
    if (program != "generator") return false;
    const std::string file(baseName(words.back()));
    if (file.empty()) return false;
    const std::vector<std::string> arguments(words.begin() + 1, words.end() - 1);
    const auto [entry, isNew] = comments.emplace(file, arguments);
    conflict = !isNew && entry->second != arguments;
    return true;
}

Repaired repair(std::string_view source, const LineIndex& lines, const ReadLimits& limits,
                Findings& findings) {
    if (source.size() > limits.bytes)
        throw Error("limit.bytes",
                    "the document has " + std::to_string(source.size()) + " bytes; at most " +
                        std::to_string(limits.bytes) + " are read",
                    lines.at(0));
    const auto byte = [&source](std::size_t i) {
        return i < source.size() ? static_cast<unsigned char>(source[i]) : 0xAAU;
    };
    if ((byte(0) == 0xFFU && byte(1) == 0xFEU) || (byte(0) == 0xFEU && byte(1) == 0xFFU) ||
        (byte(0) == '<' && byte(1) == 0) || (byte(0) == 0 && byte(1) == '<'))
        throw Error("xml.encoding", "the document is in UTF-16; save it as UTF-8", lines.at(0));
    if (trimmed(source).empty() || trimmed(source) == "\xEF\xBB\xBF")
        throw Error("xml.empty", "the document is empty", lines.at(0));
    if (const std::size_t nul = source.find('\0'); nul != std::string_view::npos)
        throw Error("xml.character", "the document holds a NUL byte: it is not text",
                    lines.at(nul));
    return RepairScanner(source, lines, limits, findings).run();
}

}  // namespace farol::scene
