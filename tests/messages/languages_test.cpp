// Each message in each language: core/languages/*.json against the tables of rows.
#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>
#include <set>

#include "cli/message_tables.h"
#include "core/language.h"

using namespace farol;

namespace {

constexpr Language kTranslations[] = {Language::pt, Language::es, Language::cs};

std::vector<const MessageRow*> everyRow() {
    std::vector<const MessageRow*> rows;
    for (const std::span<const MessageRow> table : cli::messageTables())
        for (const MessageRow& row : table) rows.push_back(&row);
    return rows;
}

/// The placeholders of a text, sorted, in one string.
std::string argumentsOf(const std::string& text) {
    static const std::regex kPlaceholder("\\{[a-z]+\\}");
    std::set<std::string> names;
    for (std::sregex_iterator at(text.begin(), text.end(), kPlaceholder), end; at != end; ++at)
        names.insert(at->str());
    std::string all;
    for (const std::string& name : names) all += name;
    return all;
}

/// The arguments, then those of each part in brackets: the parts may stand in another order.
std::multiset<std::string> formOf(std::string_view text) {
    static const std::regex kPart("\\[[^\\]]*\\]");
    const std::string whole(text);
    std::multiset<std::string> form{"all " + argumentsOf(whole)};
    for (std::sregex_iterator at(whole.begin(), whole.end(), kPart), end; at != end; ++at)
        form.insert("part " + argumentsOf(at->str()));
    return form;
}

/// Whether a text has words that a translation changes: more than placeholders, numbers and signs.
bool hasWords(std::string text) {
    text = std::regex_replace(text, std::regex("\\{[a-z]+\\}"), "");
    return std::regex_search(text, std::regex("[a-z]{2}"));
}

/// Messages that are the same in English and another language: names of elements, which stay.
const std::set<std::string_view> kEqual{"part.page/error",      "part.element/rotate",
                                        "part.element/scale",   "part.element/translate",
                                        "part.transform/scale", "part.transform/translate",
                                        "part.patches"};

std::string listOf(const std::vector<std::string_view>& ids) {
    std::string list;
    for (const std::string_view id : ids) list += "\n  " + std::string(id);
    return list;
}

/// The rule that a translation breaks; "" where there is none.
std::string faultOf(std::string_view english, std::string_view text) {
    if (text.empty()) return "is empty";
    if (text.ends_with('.') || text.ends_with(';') || text.ends_with(' ')) return "ends wrongly";
    if (text.find("  ") != std::string_view::npos) return "has two blanks";
    if (formOf(text) != formOf(english)) return "has other arguments or brackets than the English";
    if (std::count(text.begin(), text.end(), '"') !=
        std::count(english.begin(), english.end(), '"'))
        return "has other quotes than the English";
    return "";
}

}  // namespace

TEST_CASE("each message has each language") {
    std::set<std::string_view> known;
    for (const MessageRow* row : everyRow()) known.insert(row->id);
    REQUIRE(known.size() > 600);
    for (const Language language : kTranslations) {
        std::vector<std::string_view> missing, unknown;
        for (const std::string_view id : known)
            if (!templateOf(language, id)) missing.push_back(id);
        for (const std::string_view id : idsOf(language))
            if (!known.contains(id)) unknown.push_back(id);
        INFO("core/languages/" << kLanguageWords[language] << ".json lacks:" << listOf(missing)
                               << "\nand has ids of no message:" << listOf(unknown));
        CHECK(missing.empty());
        CHECK(unknown.empty());
    }
}

TEST_CASE("each translation has the arguments, brackets and quotes of the English text") {
    for (const Language language : kTranslations)
        for (const MessageRow* row : everyRow()) {
            const auto text = templateOf(language, row->id);
            if (!text) continue;
            INFO(kLanguageWords[language] << " " << row->id << ": " << *text);
            CHECK(faultOf(row->text, *text) == "");
        }
}

TEST_CASE("the check of a translation finds what breaks the rules") {
    CHECK(faultOf("{a} of {b}[ ({c})]", "{b}:[ ({c})] {a}") == "");
    for (const char* wrong :
         {"", "{a} de {b}", "{a} de {b} ({c})", "{a} de {d}[ ({c})]", "{a}  {b}[ ({c})]",
          "{a} de {b}[ ({c})].", "\"{a}\" de {b}[ ({c})]", "{a}[ {b}][ ({c})]"})
        CHECK(faultOf("{a} of {b}[ ({c})]", wrong) != "");
}

TEST_CASE("no translation is the English text") {
    for (const Language language : kTranslations)
        for (const MessageRow* row : everyRow()) {
            const auto text = templateOf(language, row->id);
            if (!text || kEqual.contains(row->id) || !hasWords(std::string(row->text))) continue;
            INFO(kLanguageWords[language] << " " << row->id);
            CHECK(*text != row->text);
        }
}

TEST_CASE("each message is rendered in each language with its samples") {
    for (const Language language : kTranslations)
        for (const MessageRow* row : everyRow()) {
            Message message;
            message.id = row->id;
            message.text = "English";
            message.arguments = sampleArguments(*row);
            const std::string text = textIn(language, message);
            INFO(kLanguageWords[language] << " " << row->id << ": " << text);
            CHECK(text != "English");
            CHECK(text.find_first_of("{}") == std::string::npos);
            for (const MessageArgument& argument : message.arguments)
                CHECK(text.find(argument.text) != std::string::npos);
        }
}

TEST_CASE("arguments that are messages are translated, and unknown ids stay English") {
    const Message found = scene::message<"scene.number">(
        "name"_arg = "x", "element"_arg = "scale", "value"_arg = "abc",
        "problem"_arg = makeMessage<"part.number-not", kCoreMessages>("suggestion"_arg = ""));
    CHECK(textIn(Language::en, found) == "\"x\" of <scale> is \"abc\", which is not a number");
    CHECK(textIn(Language::pt, found) == "\"x\" de <scale> é \"abc\", que não é um número");
    CHECK(textIn(Language::es, found) == "\"x\" de <scale> es \"abc\", que no es un número");
    CHECK(textIn(Language::cs, found) == "\"x\" v <scale> je \"abc\": není to číslo");

    Diagnostic other;
    other.id = "scene.of-a-newer-version";
    other.message = "as it came";
    const Diagnostics both =
        translated(Language::cs, {other, diagnosticOf(Severity::error, found, {"a.xml", 3, 4})});
    CHECK(both[0].message == "as it came");
    CHECK(both[1].message == "\"x\" v <scale> je \"abc\": není to číslo");
    CHECK(both[1].where.line == 3);
    CHECK(both[1].code == "scene.number");
}
