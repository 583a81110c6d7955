#include "scene/repair_scanner.h"

#include <algorithm>

#include "scene/number.h"
#include "scene/tables.h"
#include "scene/text.h"
#include "scene/words.h"

namespace farol::scene {
namespace {

bool isNameStart(char c) {
    const char l = lowerCase(c);
    return (l >= 'a' && l <= 'z') || c == '_' || c == ':' || static_cast<unsigned char>(c) >= 0x80;
}

bool isNameChar(char c) { return isNameStart(c) || (c >= '0' && c <= '9') || c == '-' || c == '.'; }

/// True for well-formed UTF-8, surrogates and overlong forms apart: good enough to tell it from
/// the one-byte encodings.
bool isUtf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const auto c = static_cast<unsigned char>(text[i++]);
        const int more = c < 0x80    ? 0
                         : c >= 0xF5 ? -1
                         : c >= 0xF0 ? 3
                         : c >= 0xE0 ? 2
                         : c >= 0xC2 ? 1
                                     : -1;
        if (more < 0) return false;
        for (int k = 0; k < more; ++k, ++i)
            if (i >= text.size() || (static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U)
                return false;
    }
    return true;
}

std::string utf8(std::string_view latin1) {
    std::string result;
    for (const char c : latin1) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) {
            result += c;
        } else {
            result += static_cast<char>(0xC0U | (byte >> 6U));
            result += static_cast<char>(0x80U | (byte & 0x3FU));
        }
    }
    return result;
}

/// True for a declaration that names Latin-1, or one of its kin that differ in a few signs.
bool declaresLatin1(std::string_view text) {
    const std::string head = lowerCase(text.substr(0, std::min<std::size_t>(text.find('>'), 200)));
    const std::size_t name = head.find("encoding");
    if (head.find("<?xml") == std::string::npos || name == std::string::npos) return false;
    for (const char* one : {"8859-1", "latin1", "latin-1", "1252"})
        if (head.find(one, name) != std::string::npos) return true;
    return false;
}

/// What closes an element that was left open.
std::string closing(std::string_view name) {
    for (const ElementSpec& one : elementSpecs())
        if (one.children.empty() && (sameWord(one.name, name) || isAmong(one.aliases, name)) &&
            !sameWord(name, "title") && !sameWord(name, "description"))
            return "end its tag with \"/>\"";
    return "write </" + shown(name) + ">";
}

}  // namespace

RepairScanner::RepairScanner(std::string_view source, const LineIndex& lines,
                             const ReadLimits& limits, Findings& findings)
    : source_(source), lines_(lines), limits_(limits), findings_(findings) {
    if (source_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
    latin1_ = !isUtf8(source_);
    if (latin1_ && !declaresLatin1(source_))
        findings_.warn("xml.encoding", where(0),
                       "the document is not UTF-8; it is read as Latin-1");
}

Repaired RepairScanner::run() {
    while (!ended()) {
        const std::size_t mark = std::min(source_.find('<', at_), source_.size());
        text(mark);
        at_ = mark;
        if (!ended()) markup();
    }
    // One finding, for the innermost: what is round it is open for the same reason.
    if (!open_.empty() && !truncated_)
        findings_.error("xml.unclosed", where(open_.back().offset),
                        "<" + shown(open_.back().name) +
                            "> is not closed: the document ends inside it; " +
                            closing(open_.back().name));
    while (!open_.empty()) pop();
    if (!rootSeen_)
        findings_.error("xml.no-root", where(0), "there is no element: this is not a scene's XML");
    return std::move(result_);
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
        if (blanks > 1) findings_.warn("xml.blank", where(at_), "a blank after \"<\" is ignored");
        return startTag();
    }
    findings_.warn("xml.stray-text", where(at_), "a stray \"<\" is ignored");
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
            "xml.stray-text", where(first),
            "the stray text " + quoted(stray) + " is ignored" +
                (number ? "; values are written as attributes: name=" + quoted(stray) : ""));
    }
}

void RepairScanner::comment() {
    const std::size_t end = source_.find("-->", at_ + 4);
    if (end == std::string_view::npos) {
        findings_.error("xml.comment", where(at_), "the comment is not closed by \"-->\"");
        truncated_ = true;
        at_ = source_.size();
        return;
    }
    const std::string_view body = source_.substr(at_ + 4, end - at_ - 4);
    if (const std::size_t dashes = body.find("--"); dashes != std::string_view::npos)
        findings_.warn("xml.comment-dashes", where(at_ + 4 + dashes),
                       "\"--\" inside a comment is ignored");
    bool conflict = false;
    takeGeneratorWords(latin1_ ? utf8(body) : std::string(body), result_.generatorComments,
                       conflict);
    if (conflict)
        findings_.warn("scene.generator-conflict", where(at_),
                       "another comment makes this file otherwise; the first one is taken");
    at_ = end + 3;
}

void RepairScanner::characterData() {
    const std::size_t begin = at_ + 9;
    const std::size_t end = std::min(source_.find("]]>", begin), source_.size());
    if (end == source_.size()) {
        findings_.error("xml.unclosed", where(at_), "the CDATA section is not closed by \"]]>\"");
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
        findings_.warn("xml.stray-text", where(at_), "the CDATA section is ignored");
    }
    at_ = std::min(end + 3, source_.size());
}

void RepairScanner::declaration() {
    findings_.error("xml.doctype", where(at_),
                    "document type declarations are not accepted; leave this one out");
    int brackets = 0;
    for (; !ended(); ++at_) {
        if (peek() == '[') ++brackets;
        if (peek() == ']') --brackets;
        if (peek() == '>' && brackets <= 0) {
            ++at_;
            return;
        }
    }
}

void RepairScanner::instruction() {
    const std::size_t end = std::min(source_.find('>', at_), source_.size());
    if (end == source_.size() || source_[end - 1] != '?' || end - at_ < 3)
        findings_.warn("xml.instruction", where(at_), "the declaration is not closed by \"?>\"");
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
        findings_.warn("xml.stray-text", where(at_), "text inside an end tag is ignored");
    at_ = end;
    if (peek() == '>')
        ++at_;
    else
        findings_.error("xml.tag", where(begin),
                        "the end tag </" + shown(closed) + "> is not closed by \">\"");
    const auto match = std::find_if(open_.rbegin(), open_.rend(),
                                    [&](const Open& one) { return sameWord(one.name, closed); });
    if (match != open_.rend()) {
        const auto inner = static_cast<std::size_t>(match - open_.rbegin());
        for (std::size_t i = 0; i < inner; ++i) {
            findings_.error("xml.unclosed", where(open_.back().offset),
                            "<" + shown(open_.back().name) + "> is not closed before </" +
                                shown(closed) + "> in line " + std::to_string(where(begin).line) +
                                "; " + closing(open_.back().name));
            pop();
        }
        if (open_.back().name != closed)
            findings_.warn(
                "xml.case", where(begin),
                "<" + shown(open_.back().name) + "> is closed by </" + shown(closed) + ">");
        pop();
        return;
    }
    const bool misspelt =
        !open_.empty() && !findings_.crowded() &&
        !didYouMean(std::string(closed), {std::string(open_.back().name)}).empty();
    findings_.error(
        "xml.mismatch", where(begin),
        "</" + shown(closed) +
            (misspelt ? "> closes <" + shown(open_.back().name) + ">; did you mean </" +
                            shown(open_.back().name) + ">?"
                      : "> closes an element that is not open" + closedEarlier(closed)));
    if (misspelt) pop();
}

/// Of an end tag too many: where its element may have been closed by "/>" unintended.
std::string RepairScanner::closedEarlier(std::string_view name) const {
    const auto found = emptied_.find(lowerCase(name));
    if (found == emptied_.end()) return "";
    return "; was it to close <" + shown(name) + "> in line " +
           std::to_string(where(found->second).line) + "? That is closed by its \"/>\" already";
}

void RepairScanner::push(std::string_view name, std::size_t offset) {
    if (open_.empty() && rootSeen_) {
        findings_.error("xml.extra-root", where(offset),
                        "<" + shown(name) + "> follows the end of the document's one root element");
    }
    rootSeen_ = true;
    if (++result_.elements > limits_.elements)
        throw Error("limit.elements", "more than " + std::to_string(limits_.elements) + " elements",
                    where(offset));
    if (open_.size() >= static_cast<std::size_t>(std::max(limits_.depth, 1)))
        throw Error("limit.depth",
                    "elements are nested deeper than " + std::to_string(limits_.depth),
                    where(offset));
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
