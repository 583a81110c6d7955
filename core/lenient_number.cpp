#include "core/lenient_number.h"

#include "core/text.h"

namespace farol {
namespace {

struct Replacement {
    std::string_view from, to;
};
constexpr Replacement kReplacements[] = {
    {"\u2212", "-"}, {"\u2010", "-"}, {"\u2011", "-"}, {"\u2012", "-"}, {"\u2013", "-"},
    {"\u2014", "-"}, {"\uFE63", "-"}, {"\uFF0D", "-"}, {"\u00A0", " "}, {"\u2009", " "},
    {"\u202F", " "}, {"\uFEFF", " "}, {"\u200B", " "},
};

/// The text with signs and blanks of ASCII.
std::string plain(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        std::size_t taken = 0;
        for (const Replacement& one : kReplacements)
            if (text.starts_with(one.from)) {
                result += one.to;
                taken = one.from.size();
            }
        if (taken == 0) result += text[taken++];
        text.remove_prefix(taken);
    }
    return result;
}

std::size_t digitsAt(std::string_view text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && isDigit(text[end])) ++end;
    return end - at;
}

/// The end of whole thousands ("1.000.000"), at least one separator; else `begin`.
std::size_t thousandsEnd(std::string_view text, std::size_t begin, char separator) {
    const std::size_t first = digitsAt(text, begin);
    if (first == 0 || first > 3) return begin;
    std::size_t at = begin + first;
    while (at < text.size() && text[at] == separator && digitsAt(text, at + 1) == 3) at += 4;
    return at > begin + first ? at : begin;
}

std::string without(std::string_view text, char separator) {
    std::string result;
    for (const char c : text)
        if (c != separator) result += c;
    return result;
}

/// Commas of one number as a point or nothing; the text as it is where there are none.
std::string withPoint(std::string_view text) {
    const std::size_t begin = text.empty() || (text[0] != '-' && text[0] != '+') ? 0 : 1;
    const auto is = [&](std::size_t at, char c) { return at < text.size() && text[at] == c; };
    const std::string sign(text.substr(0, begin));
    // "1.000,5"
    std::size_t end = thousandsEnd(text, begin, '.');
    if (end > begin && is(end, ',') && digitsAt(text, end + 1) > 0)
        return sign + without(text.substr(begin, end - begin), '.') + "." +
               std::string(text.substr(end + 1));
    // "1,000.5" and "1,234,567"; "1,234" alone is a decimal comma.
    end = thousandsEnd(text, begin, ',');
    const std::string whole = without(text.substr(begin, end - begin), ',');
    const bool many = end > begin && end - begin > whole.size() + 1;
    if (end > begin && !is(end, ',') && (is(end, '.') || many))
        return sign + whole + std::string(text.substr(end));
    const std::size_t comma = begin + digitsAt(text, begin);
    if (is(comma, ',') && digitsAt(text, comma + 1) > 0) {
        // "1,2,3" are three numbers, of which the first is read.
        const std::size_t after = comma + 1 + digitsAt(text, comma + 1);
        if (is(after, ',') && digitsAt(text, after + 1) > 0)
            return std::string(text.substr(0, comma));
        return std::string(text.substr(0, comma)) + "." + std::string(text.substr(comma + 1));
    }
    return std::string(text);
}

}  // namespace

ParsedNumber leadingNumber(std::string_view text) {
    const ParsedNumber refused = parseNumber(text);
    if (refused.problem.empty() || text.find('=') != std::string_view::npos) return refused;
    std::string word(trimmed(plain(text)));
    if (word.size() > 1 && (word[0] == '-' || word[0] == '+') && isBlank(word[1]))
        word = word[0] + std::string(trimmed(word.substr(1)));
    word = withPoint(word);
    const std::size_t sign = !word.empty() && (word[0] == '-' || word[0] == '+') ? 1 : 0;
    if (digitsAt(word, sign) == 1 && word[sign] == '0' && word.size() > sign + 1 &&
        lowerCase(word[sign + 1]) == 'x')
        return refused;
    // The longest of: sign, digits, point, digits, exponent.
    std::size_t end = sign + digitsAt(word, sign);
    std::size_t digits = end - sign;
    if (end < word.size() && word[end] == '.') {
        const std::size_t fraction = digitsAt(word, end + 1);
        digits += fraction;
        end += 1 + fraction;
    }
    if (digits == 0) return refused;
    if (end < word.size() && lowerCase(word[end]) == 'e') {
        std::size_t exponent = end + 1;
        if (exponent < word.size() && (word[exponent] == '-' || word[exponent] == '+')) ++exponent;
        if (digitsAt(word, exponent) > 0) end = exponent + digitsAt(word, exponent);
    }
    return parseNumber(std::string_view(word).substr(0, end));
}

}  // namespace farol
