#include "core/text.h"

#include <catch2/catch.hpp>
#include <set>

#include "core/enum_words.h"
#include "core/error.h"
#include "core/number.h"

using namespace farol;

TEST_CASE("only the letters of ASCII have cases") {
    CHECK(lowerCase("AbZ09_\xC3\x89[`{@") == "abz09_\xC3\x89[`{@");
    CHECK(sameWord("Torus", "tORUS"));
    CHECK_FALSE(sameWord("torus", "toru"));
    CHECK_FALSE(sameWord("\xC3\x89", "\xC3\xA9"));
    CHECK((isAlphanumeric('a') && isAlphanumeric('Z') && isAlphanumeric('0')));
    CHECK_FALSE((isAlphanumeric('_') || isAlphanumeric('\xE9') || isDigit('a')));
}

TEST_CASE("blanks at the ends are trimmed, inner ones kept") {
    CHECK(trimmed(" \t a b\r\n") == "a b");
    CHECK(trimmed("\ta\n", kLineBlanks) == "a\n");
    CHECK(trimmed("").empty());
    CHECK(trimmed(" \r ").empty());
}

TEST_CASE("words are split and joined") {
    using Words = std::vector<std::string_view>;
    CHECK(split("  a\tbc \n") == Words{"a", "bc"});
    CHECK(split("").empty());
    CHECK(split(" \n").empty());
    CHECK(split("a_b c", "_") == Words{"a", "b c"});
    CHECK(joined(Words{"a", "", "b"}, ", ") == "a, , b");
    CHECK(joined(Words{}, ", ").empty());
    CHECK(joined(std::set<int>{2, 1}, " ", [](int n) { return std::to_string(n); }) == "1 2");
}

TEST_CASE("a file's ending is that of its base name, in lower case") {
    CHECK(fileEnding("a/b.c/Brick.PNG") == "png");
    CHECK(fileEnding("a\\b.Tar.gz") == "gz");
    CHECK(fileEnding("a.b/c").empty());
    CHECK(fileEnding(".png").empty());
    CHECK(fileEnding("a.").empty());
    CHECK(fileEnding("").empty());
}

TEST_CASE("an exact number is the whole text") {
    CHECK(parseExact<int>("-12") == -12);
    CHECK(parseExact<unsigned>("4294967295") == 4294967295U);
    CHECK(parseExact<double>("1.5e3") == 1500.0);
    for (const char* text : {"", " 1", "1 ", "+1", "0x1", "1,5", "99999999999999999999", "1a"})
        CHECK_FALSE(parseExact<int>(text));
    CHECK_FALSE(parseExact<unsigned>("-1"));
    for (const char* text : {"inf", "nan", "1e999", "1,5", "+1.0", "0x1p3"})
        CHECK_FALSE(parseExact<double>(text));
}

TEST_CASE("values and words of an enumeration are found by each other") {
    for (const Severity severity : {Severity::info, Severity::warning, Severity::error})
        CHECK(kSeverityWords.find(kSeverityWords[severity]) == severity);
    CHECK_FALSE(kSeverityWords.find("Error"));
    CHECK_FALSE(kSeverityWords.find(""));
    CHECK(joined(kSeverityWords.all(), "|") == "info|warning|error");
}
