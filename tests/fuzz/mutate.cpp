#include "tests/fuzz/mutate.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace farol::fuzz {
namespace {

using namespace std::string_view_literals;

/// Numbers at the ends of what types and bounds hold.
constexpr std::array kNumbers{
    "0"sv,          "-0"sv,          "1"sv,          "-1"sv,         "2"sv,
    "3"sv,          "16"sv,          "64"sv,         "255"sv,        "256"sv,
    "4096"sv,       "4097"sv,        "65535"sv,      "65536"sv,      "2147483647"sv,
    "2147483648"sv, "-2147483648"sv, "4294967295"sv, "4294967296"sv, "18446744073709551616"sv,
    "1e308"sv,      "-1e308"sv,      "1e309"sv,      "1e-308"sv,     "1e-320"sv,
    "1e18"sv,       "1.1e18"sv,      "1e19"sv,       "1e38"sv,       "3.5e38"sv,
    "nan"sv,        "inf"sv,         "-inf"sv,       "0x10"sv,       "1e"sv,
    "."sv,          "+"sv,           "-"sv,          "0.5f"sv,       "1,5"sv,
    "000"sv,        "1e-9"sv,        "179.999"sv,    "360"sv,        "0.1"sv};

constexpr std::string_view kBytes = "\0\n\r\t \"'&<>/=;:,.-+#%0919azAZ_\\|\x7F\x80\xC3\xFF\xFE"sv;

bool isDigit(char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-'; }
bool isLetter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '-';
}

}  // namespace

std::string Mutator::mutate(std::string text, const std::string& other, std::size_t maxSize) {
    const std::size_t edits = std::size_t{1} << below(4);
    for (std::size_t i = 0; i < edits; ++i) {
        edit(text, other);
        if (text.size() > maxSize) text.resize(maxSize);
    }
    return text;
}

void Mutator::edit(std::string& text, const std::string& other) {
    switch (below(8)) {
        case 0:
        case 1:
            return editBytes(text);
        case 2:
        case 3:
            return editRanges(text, other);
        case 4:
            return nest(text);
        default:
            return editWords(text, other);
    }
}

void Mutator::editBytes(std::string& text) {
    const std::size_t at = below(text.size());
    switch (below(5)) {
        case 0:
            if (!text.empty()) text[at] = static_cast<char>(text[at] ^ (1 << below(8)));
            break;
        case 1:
            if (!text.empty()) text[at] = kBytes[below(kBytes.size())];
            break;
        case 2:
            text.insert(at, 1 + below(4), kBytes[below(kBytes.size())]);
            break;
        case 3:
            text.erase(at, 1 + below(4));
            break;
        default: {  // a number of a binary format, in either order of bytes
            const std::size_t width = std::size_t{1} << below(4);
            static constexpr std::array<std::uint64_t, 8> kValues{
                0, 1, 0x7F, 0xFF, 0x7FFF'FFFF, 0xFFFF'FFFF, 0x8000'0000, 0x7FF8'0000'0000'0000};
            const std::uint64_t value = kValues[below(kValues.size())];
            const bool bigEndian = below(2) == 0;
            for (std::size_t i = 0; i < width && at + i < text.size(); ++i)
                text[at + i] =
                    static_cast<char>(value >> (8 * (bigEndian ? width - 1 - i : i)) & 0xFFU);
        }
    }
}

void Mutator::editRanges(std::string& text, const std::string& other) {
    const Range piece = below(2) == 0 ? range(text) : line(text);
    switch (below(6)) {
        case 0:
            text.erase(piece.begin, piece.size);
            break;
        case 1: {
            const std::string copy = text.substr(piece.begin, piece.size);
            const std::size_t times = below(8) == 0 ? 1 + below(300) : 1;
            std::string copies;
            for (std::size_t i = 0; i < times && copies.size() < 32'768; ++i) copies += copy;
            text.insert(piece.begin, copies);
            break;
        }
        case 2: {  // moved to another place
            const std::string copy = text.substr(piece.begin, piece.size);
            text.erase(piece.begin, piece.size);
            text.insert(below(text.size() + 1), copy);
            break;
        }
        case 3:
            text.resize(below(text.size() + 1));
            break;
        case 4: {  // the head of one and the tail of the other
            const Range tail = below(2) == 0 ? range(other) : line(other);
            text = text.substr(0, piece.begin) + other.substr(tail.begin);
            break;
        }
        default: {
            const Range taken = below(2) == 0 ? range(other) : line(other);
            text.insert(piece.begin, other, taken.begin, taken.size);
        }
    }
}

void Mutator::editWords(std::string& text, const std::string& other) {
    switch (below(6)) {
        case 0:
        case 1: {
            const Range number = run(text, isDigit);
            text.replace(number.begin, number.size, kNumbers[below(kNumbers.size())]);
            break;
        }
        case 2: {
            const Range word = run(text, isLetter);
            text.replace(word.begin, word.size, token());
            break;
        }
        case 3:
            text.insert(below(text.size() + 1), token());
            break;
        case 4: {
            const Range word = run(text, isLetter), another = run(other, isLetter);
            text.replace(word.begin, word.size, other, another.begin, another.size);
            break;
        }
        default: {
            const Range number = run(text, isDigit), another = run(other, isDigit);
            text.replace(number.begin, number.size, other, another.begin, another.size);
        }
    }
}

/// A token or a line many times over: nesting without end, counts over every bound.
void Mutator::nest(std::string& text) {
    if (below(8) != 0) return editBytes(text);
    const Range piece = line(text);
    const std::string unit = below(2) == 0 ? token() : text.substr(piece.begin, piece.size);
    const std::size_t times = std::size_t{1} << below(13);
    std::string many;
    for (std::size_t i = 0; i < times && many.size() < 65'536; ++i) many += unit;
    text.insert(below(2) == 0 ? piece.begin : below(text.size() + 1), many);
}

Mutator::Range Mutator::range(const std::string& text) {
    const std::size_t begin = below(text.size());
    const std::size_t most = text.size() - begin;
    return {begin, std::min(most, below(4) == 0 ? below(most + 1) : 1 + below(32))};
}

Mutator::Range Mutator::line(const std::string& text) {
    const std::size_t at = below(text.size());
    const std::size_t before = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    const std::size_t end = text.find('\n', at);
    return {begin, (end == std::string::npos ? text.size() : end + 1) - begin};
}

/// The run of such characters nearest after a random place.
Mutator::Range Mutator::run(const std::string& text, bool (*belongs)(char)) {
    const auto from = text.begin() + static_cast<std::ptrdiff_t>(below(text.size()));
    const auto begin = std::find_if(from, text.end(), belongs);
    const auto end = std::find_if_not(begin, text.end(), belongs);
    return {static_cast<std::size_t>(begin - text.begin()), static_cast<std::size_t>(end - begin)};
}

std::string Mutator::token() {
    if (tokens_.empty() || below(4) == 0) return std::string(kNumbers[below(kNumbers.size())]);
    return tokens_[below(tokens_.size())];
}

}  // namespace farol::fuzz
