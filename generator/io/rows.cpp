#include "generator/io/rows.h"

#include <charconv>
#include <cmath>

namespace farol::generator::io {
namespace {

bool isSeparator(char c) {
    return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r' || c == '\v' || c == '\f';
}

/// A token as a message may show it: short, and without control characters.
std::string shown(std::string_view token) {
    std::string text(token.substr(0, 24));
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7E) c = '?';
    return "\"" + text + "\"";
}

double parseToken(std::string_view token, const Location& where) {
    const char* begin = token.data();
    const char* end = begin + token.size();
    if (token.size() > 1 && *begin == '+' && begin[1] != '-') ++begin;
    double value = 0;
    auto [stop, failed] = std::from_chars(begin, end, value);
    if (stop != end && stop + 1 == end && (*stop == 'f' || *stop == 'F')) ++stop;
    if (stop != end || failed == std::errc::invalid_argument)
        throw Error("mesh.syntax", shown(token) + " is not a number", where);
    if (failed == std::errc::result_out_of_range) {
        // Too small reads as zero; too large is refused below.
        const std::string text(token);
        const bool small = text.find("e-") != std::string::npos ||
                           text.find("E-") != std::string::npos || text.find("0.0") == 0;
        value = small ? 0.0 : HUGE_VAL;
    }
    if (!std::isfinite(value) || std::abs(value) > kMaxCoordinate)
        throw Error("mesh.number", shown(token) + " is not a finite number within 1e18", where);
    return value;
}

}  // namespace

void NumberRows::refuse(const char* code, const Row& row, const std::string& message) const {
    throw Error(code, message, {file, row.line, 1});
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
        const std::size_t comment = std::min(text.find('#'), text.find("//"));
        const bool commented = comment != std::string_view::npos;
        if (commented) text = text.substr(0, comment);
        const auto first = static_cast<std::uint32_t>(out.values.size());
        for (std::size_t at = 0; at < text.size();) {
            if (isSeparator(text[at])) {
                ++at;
                continue;
            }
            std::size_t stop = at;
            while (stop < text.size() && !isSeparator(text[stop])) ++stop;
            out.values.push_back(parseToken(text.substr(at, stop - at),
                                            {file, line, static_cast<int>(at) + column}));
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
        throw Error("mesh.empty", "the mesh file holds no numbers", {file, firstLine, firstColumn});
    return out;
}

bool isCount(double value) { return value >= 0 && value == std::floor(value); }

std::uint32_t indexIn(const NumberRows& rows, const Row& row, double value, std::size_t size) {
    if (!isCount(value))
        rows.refuse("mesh.index", row, "an index must be a whole number of at least 0");
    if (value >= static_cast<double>(size))
        rows.refuse("mesh.index", row,
                    "the index " + std::to_string(static_cast<long long>(value)) +
                        " is out of range: there are " + std::to_string(size) + " vertices");
    return static_cast<std::uint32_t>(value);
}

}  // namespace farol::generator::io
