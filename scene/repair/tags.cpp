#include <algorithm>
#include <charconv>

#include "core/text.h"
#include "scene/messages.h"
#include "scene/read/tables.h"
#include "scene/repair/scanner.h"

namespace farol::scene {
namespace {

bool isNameByte(char c) {
    const char l = lowerCase(c);
    return (l >= 'a' && l <= 'z') || c == '_' || c == ':' || static_cast<unsigned char>(c) >= 0x80;
}

bool isLegal(unsigned long code) {
    return code == 9 || code == 10 || code == 13 || (code >= 0x20 && code < 0xD800) ||
           (code > 0xDFFF && code < 0xFFFE) || (code > 0xFFFF && code < 0x110000);
}

bool hasChildren(std::string_view name) {
    const auto specs = elementSpecs();
    return std::any_of(specs.begin(), specs.end(), [name](const ElementSpec& one) {
        return sameWord(one.name, name) && !one.children.empty();
    });
}

}  // namespace

void RepairScanner::startTag() {
    const std::size_t begin = at_++;
    skipBlanks();
    const std::size_t nameAt = at_;
    const std::string_view element = name();
    push(element, begin);
    literal("<");
    copy(nameAt, at_);
    for (;;) {
        const bool blank = skipBlanks();
        if (ended() || peek() == '<') {
            findings_.error(message<"xml.tag">("element"_arg = element), where(begin));
            literal(">");
            return;
        }
        if (peek() == '>') {
            ++at_;
            literal(">");
            return;
        }
        if (peek() == '/') {
            std::size_t next = 1;
            while (isBlank(peek(next))) ++next;
            if (peek(next) == '>') {
                if (next > 1) findings_.warn(message<"xml.blank/slash">(), where(at_));
                at_ += next + 1;
                literal(">");
                if (hasChildren(element)) emptied_[lowerCase(element)] = begin;
                pop();
                return;
            }
            if (next > 1 && peek(next) == '<') {  // "<up y="1" /" and the next line
                findings_.warn(message<"xml.tag/slash">("element"_arg = element), where(begin));
                at_ += next;
                literal(">");
                pop();
                return;
            }
        }
        if (attribute(!blank)) continue;
        const std::size_t stray = at_;
        while (!ended() && !isBlank(peek()) && peek() != '<' && peek() != '>' &&
               (at_ == stray || (!isNameByte(peek()) && peek() != '/')))
            ++at_;
        findings_.warn(
            message<"xml.stray-text/tag">("text"_arg = source_.substr(stray, at_ - stray),
                                          "element"_arg = element),
            where(stray));
    }
}

bool RepairScanner::attribute(bool glued) {
    if (!isNameByte(peek()) || curlyQuote(at_) != 0) return false;
    const std::size_t nameAt = at_;
    const std::string_view key = name();
    const std::size_t nameEnd = at_;
    skipBlanks();
    if (peek() != '=') {
        findings_.warn(message<"xml.no-value">("name"_arg = key), where(nameAt));
        at_ = nameEnd;
        return true;
    }
    if (glued) findings_.warn(message<"xml.blank">("name"_arg = key), where(nameAt));
    ++at_;
    skipBlanks();
    const auto [begin, end] = attributeValue(key);
    literal(" ");
    copy(nameAt, nameEnd);
    literal("=\"");
    copy(begin, end);
    literal("\"");
    return true;
}

std::pair<std::size_t, std::size_t> RepairScanner::attributeValue(std::string_view key) {
    const std::size_t curly = curlyQuote(at_);
    if (peek() != '"' && peek() != '\'' && curly == 0) return bareValue();
    const std::size_t open = at_;
    const char quote = peek();
    at_ += std::max<std::size_t>(curly, 1);
    const std::size_t begin = at_;
    std::size_t end = begin;
    const auto closes = [&](std::size_t at) {
        return curly != 0 ? curlyQuote(at) != 0 : source_[at] == quote;
    };
    while (end < source_.size() && source_[end] != '<' && !closes(end)) ++end;
    if (end < source_.size() && source_[end] != '<') {
        at_ = end + (curly != 0 ? curlyQuote(end) : 1);
        if (curly != 0) findings_.warn(message<"xml.quote-style">(), where(open));
        return {begin, end};
    }
    findings_.error(message<"xml.quote">("name"_arg = key,
                                         "quote"_arg = std::string(1, curly != 0 ? '"' : quote)),
                    where(open));
    return bareValue();
}

std::pair<std::size_t, std::size_t> RepairScanner::bareValue() {
    const std::size_t begin = at_;
    const bool quoteLost = begin > 0 && (source_[begin - 1] == '"' || source_[begin - 1] == '\'');
    while (!ended() && !isBlank(peek()) && peek() != '<' && peek() != '>' && peek() != '"' &&
           peek() != '\'' && !(peek() == '/' && peek(1) == '>'))
        ++at_;
    if (!quoteLost)
        findings_.warn(message<"xml.unquoted">("value"_arg = source_.substr(begin, at_ - begin)),
                       where(begin));
    return {begin, at_};
}

/// The length of a typographic quote at this place, or 0.
std::size_t RepairScanner::curlyQuote(std::size_t at) const {
    if (latin1_ || at >= source_.size() || source_[at] != '\xE2') return 0;
    for (const std::string_view quote :
         {"\xE2\x80\x9C", "\xE2\x80\x9D", "\xE2\x80\x9E", "\xE2\x80\x98", "\xE2\x80\x99"})
        if (source_.compare(at, quote.size(), quote) == 0) return quote.size();
    return 0;
}

void RepairScanner::literal(std::string_view made) { result_.text += made; }

void RepairScanner::copy(std::size_t begin, std::size_t end) {
    result_.origins.emplace_back(result_.text.size(), begin);
    for (std::size_t i = begin; i < end;) {
        const char c = source_[i];
        const auto byte = static_cast<unsigned char>(c);
        if (c == '&') {
            i = reference(i, end);
            continue;
        }
        if (c == '<') {
            literal("&lt;");
        } else if (c == '"') {
            literal("&quot;");
        } else if (byte < 0x20 && !isBlank(c)) {
            findings_.warn(message<"xml.character">(), where(i));
            literal(" ");
        } else if (latin1_ && byte >= 0x80) {
            result_.text += static_cast<char>(0xC0U | (byte >> 6U));
            result_.text += static_cast<char>(0x80U | (byte & 0x3FU));
        } else {
            result_.text += c;
        }
        ++i;
    }
}

/// Copies the entity or character reference at an "&"; returns the offset after it.
std::size_t RepairScanner::reference(std::size_t at, std::size_t end) {
    constexpr std::size_t kMaxShown = 32;
    const std::string_view near = source_.substr(at, std::min(end - at, kMaxShown));
    const std::size_t semicolon = at + std::min(near.find(';'), near.size());
    const std::string_view word = semicolon < at + near.size()
                                      ? source_.substr(at + 1, semicolon - at - 1)
                                      : std::string_view();
    if (word == "lt" || word == "gt" || word == "amp" || word == "quot" || word == "apos") {
        literal(source_.substr(at, word.size() + 2));
        return semicolon + 1;
    }
    if (word.size() > 1 && word.front() == '#') {
        const bool hex = word[1] == 'x' || word[1] == 'X';
        const std::string_view digits = word.substr(hex ? 2 : 1);
        unsigned long code = 0;
        const auto [last, failed] =
            std::from_chars(digits.data(), digits.data() + digits.size(), code, hex ? 16 : 10);
        if (failed == std::errc{} && last == digits.data() + digits.size() && isLegal(code)) {
            literal("&#" + std::to_string(code) + ";");
            return semicolon + 1;
        }
        findings_.error(
            message<"xml.entity/number">("value"_arg = source_.substr(at, word.size() + 2)),
            where(at));
        return semicolon + 1;
    }
    const bool named = !word.empty() && std::all_of(word.begin(), word.end(), [](char c) {
        return isNameByte(c) || isDigit(c);
    });
    if (named) {
        findings_.error(message<"xml.entity">("value"_arg = source_.substr(at, word.size() + 2)),
                        where(at));
        return semicolon + 1;
    }
    findings_.warn(message<"xml.ampersand">(), where(at));
    literal("&amp;");
    return at + 1;
}

}  // namespace farol::scene
