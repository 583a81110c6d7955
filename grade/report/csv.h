#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace farol::grade {

/// A quoted field (RFC 4180) of UTF-8 without control characters but for tab and line feed. One
/// that a spreadsheet would take for a formula starts with an apostrophe.
std::string forCsv(const std::string& text);

/// A table that a teacher wrote: a row of column names, then rows. Commas or semicolons, with or
/// without quotes, a byte order mark and blank lines; columns in any order and any case.
class CsvTable {
  public:
    /// `columns` are those that the table must have; `file` is its name in errors. Throws Error
    /// grade.table: a column is missing, more than 100,000 rows.
    CsvTable(std::string_view text, const std::string& file,
             std::initializer_list<std::string_view> columns);
    std::size_t count() const { return rows_.size(); }
    /// Returns the trimmed field, "" where the row is short or there is no such column.
    std::string at(std::size_t row, std::string_view column) const;
    int lineOf(std::size_t row) const { return rows_[row].line; }

  private:
    struct Row {
        std::vector<std::string> fields;
        int line;  ///< of the file, from 1
    };
    std::vector<std::string> columns_;
    std::vector<Row> rows_;
};

}  // namespace farol::grade
