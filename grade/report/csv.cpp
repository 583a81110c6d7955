#include "grade/report/csv.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"
#include "grade/messages.h"

namespace farol::grade {
namespace {

constexpr std::size_t kMaxRows = 100'000;

/// Whether a spreadsheet would read the field as a formula (also by a full-width sign).
bool isFormula(const std::string& field) {
    for (const char* start : {"=", "+", "-", "@", "\t", "\n", "\xEF\xBC\x9D", "\xEF\xBC\x8B",
                              "\xEF\xBC\x8D", "\xEF\xBC\xA0"})
        if (field.starts_with(start)) return true;
    return false;
}

}  // namespace

std::string forCsv(const std::string& text) {
    std::string field = toUtf8(text);
    std::erase_if(field, [](char c) {
        return (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\n') || c == 0x7F;
    });
    if (isFormula(field)) field.insert(field.begin(), '\'');
    std::string out = "\"";
    for (const char c : field) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

CsvTable::CsvTable(std::string_view text, const std::string& file,
                   std::initializer_list<std::string_view> columns) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    const std::string_view head = text.substr(0, text.find('\n'));
    const char separator =
        std::count(head.begin(), head.end(), ';') > std::count(head.begin(), head.end(), ',') ? ';'
                                                                                              : ',';
    Row row{{""}, 1};
    bool isQuoted = false;
    int line = 1;
    const auto endRow = [&] {
        const bool isBlank =
            std::all_of(row.fields.begin(), row.fields.end(),
                        [](const std::string& field) { return trimmed(field).empty(); });
        if (!isBlank && columns_.empty())
            for (const std::string& name : row.fields) columns_.push_back(lowerCase(trimmed(name)));
        else if (!isBlank)
            rows_.push_back(std::move(row));
        if (rows_.size() > kMaxRows)
            throw Error(message<"grade.table/rows">("max"_arg = kMaxRows), {file, line, 0});
        row = {{""}, line};
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        line += c == '\n' ? 1 : 0;
        if (isQuoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
            row.fields.back() += text[i++];
        else if (c == '"' && (isQuoted || trimmed(row.fields.back()).empty()))
            isQuoted = !isQuoted;
        else if (!isQuoted && c == separator)
            row.fields.emplace_back();
        else if (!isQuoted && c == '\n')
            endRow();
        else
            row.fields.back() += c;
    }
    endRow();
    for (const std::string_view column : columns)
        if (std::find(columns_.begin(), columns_.end(), column) == columns_.end())
            throw Error(
                message<"grade.table/column">(
                    "column"_arg = column,
                    "expected"_arg = joined(std::vector(columns.begin(), columns.end()), ", ")),
                {file, 1, 0});
}

std::string CsvTable::at(std::size_t row, std::string_view column) const {
    const auto found = std::find(columns_.begin(), columns_.end(), column);
    const auto place = static_cast<std::size_t>(found - columns_.begin());
    const std::vector<std::string>& fields = rows_[row].fields;
    if (found == columns_.end() || place >= fields.size()) return "";
    // An apostrophe that forCsv wrote is none of the name's.
    std::string field(trimmed(toUtf8(fields[place])));
    if (field.size() > 1 && field[0] == '\'' && isFormula(field.substr(1))) field.erase(0, 1);
    return field;
}

}  // namespace farol::grade
