#include "scene/repair/scanner.h"

#include <algorithm>

#include "core/did_you_mean.h"
#include "core/number.h"
#include "core/text.h"
#include "scene/messages.h"
#include "scene/read/tables.h"

namespace farol::scene {
namespace {

bool isNameStart(char c) {
    const char l = lowerCase(c);
    return (l >= 'a' && l <= 'z') || c == '_' || c == ':' || static_cast<unsigned char>(c) >= 0x80;
}

bool isNameChar(char c) { return isNameStart(c) || isDigit(c) || c == '-' || c == '.'; }

/// True for a declaration of Latin-1, or of a similar encoding with a few other characters.
bool declaresLatin1(std::string_view text) {
    const std::string head = lowerCase(text.substr(0, std::min<std::size_t>(text.find('>'), 200)));
    const std::size_t name = head.find("encoding");
    if (head.find("<?xml") == std::string::npos || name == std::string::npos) return false;
    for (const char* one : {"8859-1", "latin1", "latin-1", "1252"})
        if (head.find(one, name) != std::string::npos) return true;
    return false;
}

/// Returns the fix for an element that was left open.
Message closing(std::string_view name) {
    for (const ElementSpec& one : elementSpecs())
        if (!one.children.empty() && one.children != "point" && sameWord(one.name, name))
            return message<"part.close-element">("element"_arg = name);
    for (const ElementSpec& one : elementSpecs())
        if (one.children.empty() && (sameWord(one.name, name) || isAmong(one.aliases, name)) &&
            !sameWord(name, "title") && !sameWord(name, "description"))
            return message<"part.close-tag">();
        else if (one.children == "point" && sameWord(one.name, name))
            return message<"part.close-either">("element"_arg = name);
    return message<"part.close-element">("element"_arg = name);
}

}  // namespace

RepairScanner::RepairScanner(std::string_view source, const LineIndex& lines,
                             const ReadLimits& limits, Findings& findings)
    : source_(source), lines_(lines), limits_(limits), findings_(findings) {
    if (source_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
    latin1_ = !isUtf8(source_);
    if (latin1_ && !declaresLatin1(source_)) findings_.warn(message<"xml.encoding">(), where(0));
}

Repaired RepairScanner::run() {
    while (!ended()) {
        const std::size_t mark = std::min(source_.find('<', at_), source_.size());
        text(mark);
        at_ = mark;
        if (!ended()) markup();
    }
    // One finding, for the innermost: its ancestors are open for the same reason.
    if (!open_.empty() && !truncated_) {
        const Open& inner = open_.back();
        findings_.error(open_.size() > 1
                            ? message<"xml.unclosed/cut">("element"_arg = inner.name,
                                                          "fix"_arg = closing(inner.name),
                                                          "outer"_arg = open_.front().name)
                            : message<"xml.unclosed">("element"_arg = inner.name,
                                                      "fix"_arg = closing(inner.name)),
                        where(inner.offset));
    }
    while (!open_.empty()) pop();
    if (roots_.empty()) findings_.error(message<"xml.no-root">(), where(0));
    warnOfRoots();
    return std::move(result_);
}

/// Warns of elements beside the root that Document::root chooses.
void RepairScanner::warnOfRoots() {
    if (roots_.size() < 2) return;
    auto chosen = std::find_if(roots_.begin(), roots_.end(),
                               [](const Open& root) { return isSceneRoot(root.name); });
    if (chosen == roots_.end()) chosen = roots_.begin();
    for (auto root = roots_.begin(); root != roots_.end(); ++root) {
        if (root == chosen) continue;
        findings_.warn(message<"xml.extra-root">(
                           "element"_arg = root->name, "root"_arg = chosen->name,
                           "line"_arg = where(chosen->offset).line,
                           "inside"_arg = root->offset > chosen->offset && !isSceneRoot(root->name)
                                              ? chosen->name
                                              : std::string_view()),
                       where(root->offset));
    }
}

void RepairScanner::markup() {
    if (starts("<!--")) return comment();
    if (starts("<![CDATA[")) return characterData();
    if (starts("<!")) return declaration();
    if (starts("<?")) return instruction();
    std::size_t blanks = 1;
    while (isBlank(peek(blanks))) ++blanks;
    if (peek(blanks) == '/') return endTag();
    if (isNameStart(peek(blanks)) && curlyQuote(at_ + blanks) == 0) {
        if (blanks > 1) findings_.warn(message<"xml.blank/open">(), where(at_));
        return startTag();
    }
    findings_.warn(message<"xml.stray-text/open">(), where(at_));
    ++at_;
    if (peek() == '>') ++at_;
}

void RepairScanner::text(std::size_t end) {
    std::size_t first = at_;
    while (first < end && isBlank(source_[first])) ++first;
    if (!open_.empty() && open_.back().keepsText) {
        copy(at_, end);
    } else if (first < end) {
        const std::string_view stray = trimmed(source_.substr(first, end - first));
        const bool number = parseNumber(stray).problem.empty();
        findings_.warn(
            message<"xml.stray-text">("text"_arg = stray, "value"_arg = number ? stray : ""),
            where(first));
    }
}

void RepairScanner::comment() {
    const std::size_t end = source_.find("-->", at_ + 4);
    if (end == std::string_view::npos) {
        findings_.error(message<"xml.comment">(), where(at_));
        truncated_ = true;
        at_ = source_.size();
        return;
    }
    const std::string_view body = source_.substr(at_ + 4, end - at_ - 4);
    if (const std::size_t dashes = body.find("--"); dashes != std::string_view::npos)
        findings_.warn(message<"xml.comment-dashes">(), where(at_ + 4 + dashes));
    bool conflict = false;
    takeGeneratorWords(latin1_ ? latin1ToUtf8(body) : std::string(body), result_.generatorComments,
                       conflict);
    if (conflict) findings_.warn(message<"scene.generator-conflict">(), where(at_));
    at_ = end + 3;
}

void RepairScanner::characterData() {
    const std::size_t begin = at_ + 9;
    const std::size_t end = std::min(source_.find("]]>", begin), source_.size());
    if (end == source_.size()) {
        findings_.error(message<"xml.unclosed/data">(), where(at_));
        truncated_ = true;
    }
    if (!open_.empty() && open_.back().keepsText) {
        for (std::size_t i = begin; i < end; ++i) {
            if (source_[i] == '&')
                literal("&amp;");
            else
                copy(i, i + 1);
        }
    } else if (!trimmed(source_.substr(begin, end - begin)).empty()) {
        findings_.warn(message<"xml.stray-text/data">(), where(at_));
    }
    at_ = std::min(end + 3, source_.size());
}

/// Skips a document type. Never opens the DTD that it names; refuses definitions of entities.
void RepairScanner::declaration() {
    const std::size_t begin = at_;
    int brackets = 0;
    bool defines = false;
    for (; !ended(); ++at_) {
        defines = defines || peek() == '[';
        if (peek() == '[') ++brackets;
        if (peek() == ']') --brackets;
        if (peek() == '>' && brackets <= 0) {
            ++at_;
            break;
        }
    }
    if (defines)
        findings_.error(message<"xml.doctype/definitions">(), where(begin));
    else
        findings_.warn(message<"xml.doctype">(), where(begin));
}

void RepairScanner::instruction() {
    const std::size_t end = std::min(source_.find('>', at_), source_.size());
    if (end == source_.size() || source_[end - 1] != '?' || end - at_ < 3)
        findings_.warn(message<"xml.instruction">(), where(at_));
    at_ = std::min(end + 1, source_.size());
}

void RepairScanner::endTag() {
    const std::size_t begin = at_++;
    skipBlanks();
    ++at_;  // the slash
    skipBlanks();
    const std::string_view closed = name();
    const std::size_t end = std::min(source_.find_first_of("<>", at_), source_.size());
    if (!trimmed(source_.substr(at_, end - at_)).empty())
        findings_.warn(message<"xml.stray-text/end-tag">(), where(at_));
    at_ = end;
    if (peek() == '>')
        ++at_;
    else
        findings_.error(message<"xml.tag/end">("element"_arg = closed), where(begin));
    const auto match = std::find_if(open_.rbegin(), open_.rend(),
                                    [&](const Open& one) { return sameWord(one.name, closed); });
    if (match != open_.rend()) {
        const auto inner = static_cast<std::size_t>(match - open_.rbegin());
        for (std::size_t i = 0; i < inner; ++i) {
            findings_.error(
                message<"xml.unclosed/inner">("element"_arg = open_.back().name,
                                              "outer"_arg = closed, "line"_arg = where(begin).line,
                                              "fix"_arg = closing(open_.back().name)),
                where(open_.back().offset));
            pop();
        }
        if (open_.back().name != closed)
            findings_.warn(
                message<"xml.case">("element"_arg = open_.back().name, "end"_arg = closed),
                where(begin));
        pop();
        return;
    }
    const bool misspelt =
        !open_.empty() && !findings_.crowded() &&
        !didYouMean(std::string(closed), {std::string(open_.back().name)}).empty();
    findings_.error(
        misspelt ? message<"xml.mismatch/misspelt">("end"_arg = closed,
                                                    "element"_arg = open_.back().name)
                 : message<"xml.mismatch">("end"_arg = closed, "line"_arg = closedEarlier(closed)),
        where(begin));
    if (misspelt) pop();
}

/// Returns the line in which the element of a surplus end tag may have been closed by "/>"
/// unintended, or "".
std::string RepairScanner::closedEarlier(std::string_view name) const {
    const auto found = emptied_.find(lowerCase(name));
    return found == emptied_.end() ? "" : std::to_string(where(found->second).line);
}

void RepairScanner::push(std::string_view name, std::size_t offset) {
    if (open_.empty()) roots_.push_back({name, offset, false});
    if (++result_.elements > limits_.elements)
        throw Error(message<"limit.elements">("max"_arg = limits_.elements), where(offset));
    if (open_.size() >= static_cast<std::size_t>(std::max(limits_.depth, 1)))
        throw Error(message<"limit.depth">("max"_arg = limits_.depth), where(offset));
    open_.push_back({name, offset, sameWord(name, "title") || sameWord(name, "description")});
}

void RepairScanner::pop() {
    literal("</");
    const auto begin = static_cast<std::size_t>(open_.back().name.data() - source_.data());
    copy(begin, begin + open_.back().name.size());
    literal(">");
    open_.pop_back();
}

bool RepairScanner::starts(std::string_view word) const {
    return source_.compare(at_, word.size(), word) == 0;
}

char RepairScanner::peek(std::size_t ahead) const {
    return at_ + ahead < source_.size() ? source_[at_ + ahead] : '\0';
}

std::string_view RepairScanner::name() {
    const std::size_t begin = at_;
    while (!ended() && isNameChar(peek()) && curlyQuote(at_) == 0) ++at_;
    return source_.substr(begin, at_ - begin);
}

bool RepairScanner::skipBlanks() {
    const std::size_t begin = at_;
    while (!ended() && isBlank(peek())) ++at_;
    return at_ > begin;
}

}  // namespace farol::scene
