// The message catalogue as one list: each row against the rules of docs/reference/style.md.
#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>
#include <set>

#include "cli/message_tables.h"
#include "core/error.h"

using namespace farol;

namespace {

std::vector<const MessageRow*> allRows() {
    std::vector<const MessageRow*> rows;
    for (const std::span<const MessageRow> table : cli::messageTables())
        for (const MessageRow& row : table) rows.push_back(&row);
    return rows;
}

bool has(const std::string& text, const char* pattern) {
    return std::regex_search(text, std::regex(pattern));
}

/// Returns the rule that a rendered message breaks; "" where there is none.
std::string faultOf(const std::string& text, bool isPart) {
    if (text.empty()) return "is empty";
    // Names of headers and formats keep their capitals: "Content-Length", "PNG".
    if (!isPart && has(text, "^[A-Z]") && !has(text, "^([A-Z]{2}|[A-Za-z]+-[A-Z])"))
        return "begins with a capital letter";
    if (text.ends_with('.') || text.ends_with(';') || text.ends_with(' ')) return "ends wrongly";
    if (has(text, "  ")) return "has two blanks";
    if (has(text, "[{}]")) return "has a placeholder that is not filled";
    if (has(text, "(^|[ (])'")) return "has single quotes";
    const std::string unquoted = std::regex_replace(text, std::regex("\"[^\"]*\""), "\"\"");
    if (has(unquoted, "[0-9]\\.\\.[0-9]")) return "has a range of dots; write \"1 to 5\"";
    static const std::regex kSentence("[.?!] +[A-Z]");
    if (std::distance(std::sregex_iterator(unquoted.begin(), unquoted.end(), kSentence),
                      std::sregex_iterator()) > 1)
        return "has more than two sentences";
    if (has(unquoted,
            "\\b(told|said|says of|mend\\w*|cures?|lend\\w*|lent|(is|are) taken|cannot be had|of "
            "its "
            "own|aloud|likes|so that it|what|who|whoever|whatever|hold to|fault|picture)\\b"))
        return "has a banned word";
    return "";
}

/// The text with each bracketed part left out in turn: its arguments are empty then.
std::vector<std::string> renderings(const MessageRow& row) {
    const MessageArguments samples = sampleArguments(row);
    std::vector<std::string> all{renderTemplate(row.text, samples)};
    static const std::regex kPart("\\[([^\\]]*)\\]");
    const std::string text(row.text);
    for (std::sregex_iterator at(text.begin(), text.end(), kPart), end; at != end; ++at) {
        MessageArguments without = samples;
        for (const std::string_view name : placeholdersOf(std::string_view(text).substr(
                 static_cast<std::size_t>(at->position()), static_cast<std::size_t>(at->length()))))
            for (MessageArgument& argument : without)
                if (argument.name == name) argument.text.clear();
        all.push_back(renderTemplate(row.text, without));
    }
    return all;
}

}  // namespace

TEST_CASE("each message keeps the rules of docs/reference/style.md") {
    const auto rows = allRows();
    REQUIRE(rows.size() > 150);
    for (const MessageRow* row : rows)
        for (const std::string& text : renderings(*row)) {
            INFO(row->id << ": " << text);
            CHECK(faultOf(text, row->id.starts_with("part.")) == "");
        }
}

TEST_CASE("the check of a message finds what breaks the rules") {
    CHECK(faultOf("no \"a\"; expected Sphere", false) == "");
    CHECK(faultOf("Content-Length is wrong", false) == "");
    CHECK(faultOf("a. B c", false) == "");
    for (const char* wrong : {"No file", "no file.", "no 'a' here", "no {name}", "a. B. C",
                              "the first is taken", "0 is what it must be", "", "1..5", "a  b"})
        CHECK(faultOf(wrong, false) != "");
}

TEST_CASE("ids are unique codes with a variant, and each placeholder has a sample") {
    std::set<std::string_view> ids;
    for (const MessageRow* row : allRows()) {
        INFO(row->id);
        CHECK(ids.insert(row->id).second);
        CHECK(has(std::string(row->id),
                  "^([a-z]+\\.[a-z]+(-[a-z]+)*|usage|internal|not-ready)(/[a-z]+(-[a-z]+)*)?$"));
        CHECK(has(std::string(row->text),
                  "^([^\\[\\]{}]|\\[([^\\[\\]{}]|\\{[a-z]+\\})*\\]|\\{[a-z]+\\})+$"));
        const auto placeholders = placeholdersOf(row->text);
        for (std::size_t i = 0; i < placeholders.size(); ++i)
            CHECK(placeholders[i].empty() == row->samples[i].empty());
    }
}

TEST_CASE("a message is rendered again from its id and arguments") {
    for (const MessageRow* row : allRows()) {
        const auto text = cli::englishTemplate(row->id);
        REQUIRE(text);
        CHECK(renderTemplate(*text, sampleArguments(*row), cli::englishTemplate) ==
              renderings(*row).front());
    }
}
