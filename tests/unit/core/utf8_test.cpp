// UTF-8 in names and messages from strangers.
#include <catch2/catch.hpp>

#include "core/text.h"

using namespace farol;

TEST_CASE("UTF-8 is told from other bytes, which are replaced one by one") {
    struct Case {
        std::string text, valid;
    };
    const std::string mark = "\xEF\xBF\xBD";
    const Case cases[] = {
        {"", ""},
        {"plain", "plain"},
        {"caf\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x98\x80 \xF4\x8F\xBF\xBF",
         "caf\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x98\x80 \xF4\x8F\xBF\xBF"},
        {"caf\xE9", "caf" + mark},
        {"\xC3", mark},                                   // cut off
        {"\xE2\x82", mark + mark},                        // cut off
        {"\xC0\x80", mark + mark},                        // overlong
        {"\xE0\x9F\xBF", mark + mark + mark},             // overlong
        {"\xF0\x8F\xBF\xBF", mark + mark + mark + mark},  // overlong
        {"\xED\xA0\x80", mark + mark + mark},             // a surrogate
        {"\xF4\x90\x80\x80", mark + mark + mark + mark},  // beyond U+10FFFF
        {"\xFF\xFE"
         "a",
         mark + mark + "a"},
        {"\x80"
         "a\xBF",
         mark + "a" + mark},
        {std::string("a\0b", 3), std::string("a\0b", 3)},
    };
    for (const Case& one : cases) {
        INFO(one.valid);
        CHECK(toUtf8(one.text) == one.valid);
        CHECK(isUtf8(one.text) == (one.text == one.valid));
        CHECK(isUtf8(nameToUtf8(one.text)));
        CHECK(isUtf8(toUtf8(one.text)));
    }
    CHECK(nameToUtf8("Jo\xE3o") == "Jo\xC3\xA3o");
    CHECK(nameToUtf8("Jo\xC3\xA3o") == "Jo\xC3\xA3o");
}
