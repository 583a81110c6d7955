#include <algorithm>
#include <map>

#include "cli/message_tables.h"
#include "cli/schema.h"

namespace farol::cli {
namespace {

/// All rows by code, then variant.
std::map<std::pair<std::string_view, std::string_view>, const MessageRow*> sortedRows() {
    std::map<std::pair<std::string_view, std::string_view>, const MessageRow*> rows;
    for (const std::span<const MessageRow> table : messageTables())
        for (const MessageRow& row : table) {
            const std::size_t slash = std::min(row.id.find('/'), row.id.size());
            rows.emplace(std::pair(row.id.substr(0, slash), row.id.substr(slash)), &row);
        }
    return rows;
}

/// A template as a cell of a Markdown table.
std::string cellOf(std::string_view text) {
    std::string cell;
    for (const char c : text) {
        if (c == '|') cell += '\\';
        cell += c;
    }
    return "`" + cell + "`";
}

}  // namespace

nlohmann::ordered_json messagesAsJson() {
    nlohmann::ordered_json all = nlohmann::ordered_json::array();
    for (const auto& [key, row] : sortedRows()) {
        nlohmann::ordered_json arguments = nlohmann::ordered_json::object();
        for (const MessageArgument& sample : sampleArguments(*row))
            arguments[sample.name] = sample.text;
        nlohmann::ordered_json entry = {{"id", row->id}, {"text", row->text}};
        if (!key.first.starts_with("part.")) entry["code"] = key.first;
        if (!arguments.empty()) entry["samples"] = arguments;
        entry["example"] = renderTemplate(row->text, sampleArguments(*row));
        all.push_back(std::move(entry));
    }
    return all;
}

std::string messagesMarkdown() {
    std::string text = "| code | message |\n| --- | --- |\n";
    std::string_view last;
    for (const auto& [key, row] : sortedRows()) {
        if (key.first.starts_with("part.")) continue;
        const std::string code = key.first == last ? "" : "`" + std::string(key.first) + "`";
        text += "| " + code + " | " + cellOf(row->text) + " |\n";
        last = key.first;
    }
    return text;
}

}  // namespace farol::cli
