#include "generator/io/rows.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/text.h"
#include "generator/messages.h"

namespace farol::generator::io {
namespace {

bool isWordChar(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// NaN and infinity as C libraries write them: nan, -nan(ind), inf, 1.#QNAN, -1.#IND00.
bool isNoNumber(std::string_view token) {
    if (!token.empty() && (token[0] == '-' || token[0] == '+')) token.remove_prefix(1);
    std::string lower;
    for (const char c : token.substr(0, 12))
        lower += static_cast<char>(isWordChar(c) ? c | 0x20 : c);
    for (const char* known : {"nan", "nan(ind", "nan(ind)", "nan(snan", "nan(snan)", "inf",
                              "infinity", "1.#inf", "1.#ind", "1.#qnan", "1.#snan"})
        if (lower == known) return true;
    // Printed with digits: 1.#INF00, -1.#IND000.
    return lower.rfind("1.#inf0", 0) == 0 || lower.rfind("1.#ind0", 0) == 0 ||
           lower.rfind("1.#qnan0", 0) == 0;
}

}  // namespace

bool isSeparator(char c) {
    return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r' || c == '\v' || c == '\f' ||
           c == '(' || c == ')' || c == '[' || c == ']' || c == '{' || c == '}' || c == '|' ||
           c == '<' || c == '>';
}

std::optional<double> numberOf(std::string_view token, const Location& where) {
    const char* begin = token.data();
    const char* end = begin + token.size();
    if (token.size() > 1 && *begin == '+' && begin[1] != '-') ++begin;
    double value = 0;
    auto [stop, failed] = std::from_chars(begin, end, value);
    if (stop != end && stop + 1 == end && (*stop == 'f' || *stop == 'F')) ++stop;
    const bool whole = stop == end && failed != std::errc::invalid_argument;
    if (!whole || std::isnan(value) || (failed == std::errc() && std::isinf(value))) {
        if (isNoNumber(token)) return std::nan("");
        return std::nullopt;
    }
    if (failed == std::errc::result_out_of_range) {
        // Too small reads as zero; too large is refused below.
        const std::string text(token);
        const bool small = text.find("e-") != std::string::npos ||
                           text.find("E-") != std::string::npos || text.find("0.0") == 0;
        value = small ? 0.0 : HUGE_VAL;
    }
    if (std::abs(value) > kMaxCoordinate)
        throw Error(message<"mesh.number/large">("value"_arg = token), where);
    return value;
}

glm::dvec3 placeAt(const NumberRows& rows, const Row& row, const double* v) {
    const glm::dvec3 place(v[0], v[1], v[2]);
    if (std::isnan(v[0] + v[1] + v[2])) rows.refuse(message<"mesh.number/nan">(), row);
    return place;
}

std::size_t commentStart(std::string_view line, bool slashesToo) {
    std::size_t at = line.find('#');
    while (at != std::string_view::npos && at >= 2 && line.substr(at - 2, 2) == "1." &&
           at + 1 < line.size() && isWordChar(line[at + 1]))
        at = line.find('#', at + 1);
    return slashesToo ? std::min(at, line.find("//")) : at;
}

std::size_t tokenEnd(std::string_view text, std::size_t at) {
    std::size_t stop = at;
    while (stop < text.size() && !isSeparator(text[stop])) ++stop;
    // "nan(ind)" is one token.
    const bool nan = stop - at >= 3 && stop < text.size() && text[stop] == '(' &&
                     isNoNumber(text.substr(stop - 3, 3));
    constexpr std::size_t kMaxSuffix = 6;  // "(snan)"
    const std::size_t close =
        nan ? text.substr(stop, kMaxSuffix).find(')') : std::string_view::npos;
    return close != std::string_view::npos ? stop + close + 1 : stop;
}

void NumberRows::refuse(Message message, const Row& row) const {
    throw Error(std::move(message), {file, row.line, 1});
}

NumberRows parseRows(std::string_view bytes, const std::string& file, int line, int column) {
    NumberRows out;
    out.file = file;
    if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
    const int firstLine = line--, firstColumn = column;
    std::uint32_t block = 0;
    bool blank = false;
    while (!bytes.empty()) {
        column = ++line == firstLine ? firstColumn : 1;
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        std::string_view text = bytes.substr(0, end);
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
        const std::size_t comment = commentStart(text);
        const bool commented = comment != std::string_view::npos;
        if (commented) text = text.substr(0, comment);
        const auto first = static_cast<std::uint32_t>(out.values.size());
        for (std::size_t at = 0; at < text.size();) {
            if (isSeparator(text[at])) {
                ++at;
                continue;
            }
            const std::size_t stop = tokenEnd(text, at);
            const Location where{file, line, static_cast<int>(at) + column};
            const std::optional<double> value = numberOf(text.substr(at, stop - at), where);
            if (!value)
                throw Error(message<"mesh.syntax/number">("value"_arg = text.substr(at, stop - at)),
                            where);
            out.values.push_back(*value);
            at = stop;
        }
        const auto count = static_cast<std::uint32_t>(out.values.size()) - first;
        if (count == 0) {
            blank = blank || !commented;
            continue;
        }
        if (blank && !out.rows.empty()) ++block;
        blank = false;
        out.rows.push_back({line, first, count, block});
    }
    if (out.rows.empty())
        throw Error(message<"mesh.empty/numbers">(), {file, firstLine, firstColumn});
    return out;
}

double indexBase(const double* begin, const double* end, std::size_t size) {
    if (begin == end) return 0.0;
    const auto [least, most] = std::minmax_element(begin, end);
    return *least >= 1.0 && *most == static_cast<double>(size) ? 1.0 : 0.0;
}

bool isCount(double value) { return value >= 0 && value == std::floor(value); }

std::uint32_t indexIn(const NumberRows& rows, const Row& row, double value, std::size_t size) {
    if (!isCount(value)) rows.refuse(message<"mesh.index/word">("value"_arg = value), row);
    if (value >= static_cast<double>(size))
        rows.refuse(message<"mesh.index/range">("index"_arg = value, "count"_arg = size), row);
    return static_cast<std::uint32_t>(value);
}

}  // namespace farol::generator::io
