#include "core/utf16.h"

#include <cstdint>

namespace farol {
namespace {

constexpr std::uint32_t kReplacement = 0xFFFD;

void append(std::string& out, std::uint32_t code) {
    const auto add = [&](std::uint32_t byte) { out += static_cast<char>(byte); };
    const auto tail = [&](unsigned shift) { add(0x80U | (code >> shift & 0x3FU)); };
    if (code < 0x80) {
        add(code);
    } else if (code < 0x800) {
        add(0xC0U | code >> 6U);
        tail(0);
    } else if (code < 0x10000) {
        add(0xE0U | code >> 12U);
        tail(6);
        tail(0);
    } else {
        add(0xF0U | code >> 18U);
        tail(12);
        tail(6);
        tail(0);
    }
}

}  // namespace

std::optional<std::string> utf16ToUtf8(std::string_view bytes) {
    using std::string_view_literals::operator""sv;
    const std::string_view head = bytes.substr(0, 2);
    const bool isMarked = head == "\xFF\xFE"sv || head == "\xFE\xFF"sv;
    // The second character has a zero too, and is none itself: 60 as a binary count is no text.
    const auto isSecond = [&](std::size_t zero, std::size_t letter) {
        return bytes.size() >= 4 && bytes[zero] == '\0' && bytes[letter] != '\0';
    };
    const bool isBareLittle = head == "<\0"sv && isSecond(3, 2);
    const bool isBareBig = head == "\0<"sv && isSecond(2, 3);
    if (!isMarked && !isBareLittle && !isBareBig) return std::nullopt;
    const bool isBig = isBareBig || head == "\xFE\xFF"sv;
    if (isMarked) bytes.remove_prefix(2);
    const auto unitAt = [&](std::size_t at) -> std::uint32_t {
        if (at + 1 >= bytes.size()) return at < bytes.size() ? kReplacement : 0;
        const auto first = static_cast<unsigned char>(bytes[at]);
        const auto second = static_cast<unsigned char>(bytes[at + 1]);
        return isBig ? first << 8U | second : second << 8U | first;
    };
    std::string out;
    out.reserve(bytes.size() / 2 + 16);
    for (std::size_t at = 0; at < bytes.size(); at += 2) {
        std::uint32_t code = unitAt(at);
        if (code >= 0xD800 && code < 0xE000) {
            const std::uint32_t low = unitAt(at + 2);
            const bool isPair = code < 0xDC00 && low >= 0xDC00 && low < 0xE000;
            if (isPair) at += 2;
            code = isPair ? 0x10000 + ((code & 0x3FFU) << 10U) + (low & 0x3FFU) : kReplacement;
        }
        append(out, code);
    }
    return out;
}

}  // namespace farol
