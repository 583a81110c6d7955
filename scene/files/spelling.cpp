#include "scene/files/spelling.h"

#include <algorithm>
#include <optional>

#include "core/text.h"
#include "scene/files/spelling_tables.h"

namespace farol::scene::spelling {
namespace {

constexpr unsigned kFirstHigh = 0x80;
constexpr CodePage kLatin1 = [] {
    CodePage page{};
    for (unsigned i = 0; i < page.size(); ++i) page[i] = static_cast<char16_t>(kFirstHigh + i);
    return page;
}();
constexpr const CodePage* kPages[] = {&kLatin1, &kCp1252, &kCp850, &kCp437, &kCp852, &kCp1250};

void append(std::string& text, char32_t character) {
    const auto tail = [&](unsigned shift) {
        text += static_cast<char>(0x80U | ((character >> shift) & 0x3FU));
    };
    if (character < 0x80) {
        text += static_cast<char>(character);
    } else if (character < 0x800) {
        text += static_cast<char>(0xC0U | character >> 6U);
        tail(0);
    } else if (character < 0x10000) {
        text += static_cast<char>(0xE0U | character >> 12U);
        tail(6);
        tail(0);
    } else {
        text += static_cast<char>(0xF0U | character >> 18U);
        tail(12);
        tail(6);
        tail(0);
    }
}

/// Takes the first character off UTF-8 text.
char32_t takeCharacter(std::string_view& text) {
    const auto byte = static_cast<unsigned char>(text[0]);
    const std::size_t length = byte < 0x80 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
    char32_t character = length == 1 ? byte : byte & (0x7FU >> length);
    for (std::size_t i = 1; i < length; ++i)
        character = character << 6U | (static_cast<unsigned char>(text[i]) & 0x3FU);
    text.remove_prefix(length);
    return character;
}

void decompose(std::string& out, char32_t character) {
    // Unicode, section 3.12: Hangul syllables by arithmetic.
    constexpr char32_t kHangul = 0xAC00, kSyllables = 11172, kLead = 0x1100, kVowel = 0x1161,
                       kTrail = 0x11A7, kTrails = 28, kOfLead = 588;
    if (character - kHangul < kSyllables) {
        const char32_t index = character - kHangul;
        append(out, kLead + index / kOfLead);
        append(out, kVowel + index % kOfLead / kTrails);
        if (index % kTrails != 0) append(out, kTrail + index % kTrails);
        return;
    }
    const auto found =
        std::lower_bound(kComposed.begin(), kComposed.end(), character,
                         [](const Composed& one, char32_t letter) { return one.letter < letter; });
    if (found == kComposed.end() || found->letter != character) {
        append(out, character);
        return;
    }
    decompose(out, found->base);
    append(out, found->mark);
}

/// The small letter of a character of decomposed text.
char32_t smallLetter(char32_t c) {
    const auto in = [c](char32_t first, char32_t last) { return c >= first && c <= last; };
    if (in('A', 'Z') || (in(0xC0, 0xDE) && c != 0xD7) || in(0x391, 0x3A9) || in(0x410, 0x42F))
        return c + 0x20;
    if (in(0x400, 0x40F)) return c + 0x50;
    // Latin Extended-A: pairs with the capital at the even or the odd place.
    if (in(0x100, 0x137) || in(0x14A, 0x177) || in(0x460, 0x4FF)) return c | 1U;
    if ((in(0x139, 0x148) || in(0x179, 0x17E)) && c % 2 == 1) return c + 1;
    return c;
}

int hexDigit(char c) {
    if (isDigit(c)) return c - '0';
    const char small = lowerCase(c);
    return small >= 'a' && small <= 'f' ? small - 'a' + 10 : -1;
}

/// Returns the text's bytes in a code page, if that has all its characters.
std::optional<std::string> encoded(std::string_view text, const CodePage& page) {
    std::string bytes;
    while (!text.empty()) {
        const char32_t character = takeCharacter(text);
        if (character < kFirstHigh) {
            bytes += static_cast<char>(character);
            continue;
        }
        const auto found = std::find(page.begin(), page.end(), character);
        if (found == page.end()) return std::nullopt;
        bytes += static_cast<char>(kFirstHigh + static_cast<unsigned>(found - page.begin()));
    }
    return bytes;
}

std::optional<std::string> decoded(std::string_view bytes, const CodePage& page) {
    std::string text;
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        const char32_t character = byte < kFirstHigh ? byte : page[byte - kFirstHigh];
        if (character == 0 && byte != 0) return std::nullopt;
        append(text, character);
    }
    return text;
}

}  // namespace

std::string percentDecoded(std::string_view name) {
    std::string out;
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (name[i] == '%' && i + 2 < name.size()) {
            const int high = hexDigit(name[i + 1]), low = hexDigit(name[i + 2]);
            if (high >= 0 && low >= 0 && high + low > 0) {
                out += static_cast<char>(high * 16 + low);
                i += 2;
                continue;
            }
        }
        out += name[i];
    }
    return out;
}

std::string decomposed(std::string_view name) {
    if (!isUtf8(name)) return std::string(name);
    std::string out;
    while (!name.empty()) decompose(out, takeCharacter(name));
    return out;
}

std::string folded(std::string_view name) {
    const std::string plain = decomposed(percentDecoded(name));
    if (!isUtf8(plain)) return lowerCase(plain);
    std::string out;
    for (std::string_view rest = plain; !rest.empty();)
        append(out, smallLetter(takeCharacter(rest)));
    return out;
}

std::vector<std::string> otherReadings(std::string_view name) {
    const auto isHigh = [](char c) { return static_cast<unsigned char>(c) >= kFirstHigh; };
    if (std::none_of(name.begin(), name.end(), isHigh)) return {};
    std::vector<std::string> sources, readings;
    if (!isUtf8(name)) {
        sources.emplace_back(name);
    } else {
        for (const CodePage* page : kPages)
            if (auto bytes = encoded(name, *page)) sources.push_back(std::move(*bytes));
    }
    for (const std::string& bytes : sources) {
        if (isUtf8(bytes)) readings.push_back(bytes);
        for (const CodePage* page : kPages)
            if (auto text = decoded(bytes, *page)) readings.push_back(std::move(*text));
    }
    std::sort(readings.begin(), readings.end());
    readings.erase(std::unique(readings.begin(), readings.end()), readings.end());
    std::erase(readings, name);
    return readings;
}

}  // namespace farol::scene::spelling
