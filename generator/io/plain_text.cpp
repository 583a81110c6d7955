#include "generator/io/plain_text.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/utf16.h"

namespace farol::generator::io {
namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

enum class Token { word, whole, comma, other };

/// Classifies a token; `other` rules out decimal commas.
Token kindOf(std::string_view token) {
    if (isLetter(token[0])) return Token::word;
    std::size_t at = token[0] == '-' || token[0] == '+' ? 1 : 0;
    const auto digits = [&] {
        const std::size_t begin = at;
        while (at < token.size() && isDigit(token[at])) ++at;
        return at > begin;
    };
    if (!digits()) return Token::other;
    bool comma = false;
    if (at < token.size() && token[at] == ',') {
        ++at;
        comma = digits();
        if (!comma) return Token::other;
    }
    if (at < token.size() && (token[at] == 'e' || token[at] == 'E')) {
        ++at;
        if (at < token.size() && (token[at] == '-' || token[at] == '+')) ++at;
        if (!digits()) return Token::other;
    }
    while (at < token.size() && token[at] == '/' && !comma) {  // corners of faces
        ++at;
        digits();
    }
    if (at != token.size()) return Token::other;
    return comma ? Token::comma : Token::whole;
}

bool hasDecimalCommas(std::string_view text) {
    constexpr std::string_view kBetween = " \t\r\n;()[]{}|";
    if (text.find(',') == std::string_view::npos) return false;
    bool several = false;
    std::size_t inLine = 0;  // numbers
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (kBetween.find(c) != std::string_view::npos) {
            if (c == '\n') inLine = 0;
            ++at;
            continue;
        }
        if (c == '#') {
            at = std::min(text.find('\n', at), text.size());
            continue;
        }
        const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
        const Token kind = kindOf(text.substr(at, end - at));
        if (kind == Token::other) return false;
        if (kind == Token::comma) several = several || inLine > 0;
        if (kind != Token::word) ++inLine;
        at = end;
    }
    return several;
}

}  // namespace

std::string_view plainText(std::string_view bytes, std::string& storage) {
    if (std::optional<std::string> wide = utf16ToUtf8(bytes)) {
        storage = std::move(*wide);
        bytes = storage;
    } else if (bytes.substr(0, 3) == "\xEF\xBB\xBF") {
        bytes.remove_prefix(3);
    }
    constexpr std::size_t kLooked = 4096;  // bytes: binary forms have a zero there
    if (bytes.substr(0, kLooked).find('\0') != std::string_view::npos) return bytes;
    const bool lone =
        bytes.find('\r') != std::string_view::npos && bytes.find('\n') == std::string_view::npos;
    const bool commas = hasDecimalCommas(bytes);
    if (!lone && !commas) return bytes;
    std::string text(bytes);
    if (lone) std::replace(text.begin(), text.end(), '\r', '\n');
    if (commas) std::replace(text.begin(), text.end(), ',', '.');
    storage = std::move(text);
    return storage;
}

}  // namespace farol::generator::io
