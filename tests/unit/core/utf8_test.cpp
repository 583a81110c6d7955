// UTF-8 in names and messages from strangers.
#include <catch2/catch.hpp>

#include "core/text.h"
#include "core/utf16.h"

using namespace farol;

TEST_CASE("UTF-8 is distinguished from other bytes, which are replaced one by one") {
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

TEST_CASE("UTF-16 becomes UTF-8, whatever its order of bytes") {
    const std::u16string text = u"<a n='caf\u00e9 \u20ac \U0001F600'/>";
    const std::string plain = "<a n='caf\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x98\x80'/>";
    for (const bool isBig : {false, true})
        for (const bool isMarked : {false, true}) {
            std::string bytes;
            for (const char16_t unit : isMarked ? u"\uFEFF" + text : text) {
                const char high = static_cast<char>(unit >> 8U), low = static_cast<char>(unit);
                bytes += isBig ? high : low;
                bytes += isBig ? low : high;
            }
            CHECK(utf16ToUtf8(bytes) == plain);
            CHECK(utf16ToUtf8(bytes + "x") == plain + "\xEF\xBF\xBD");
        }
    using std::string_literals::operator""s;
    const std::string mark = "\xEF\xBF\xBD";
    CHECK(utf16ToUtf8("\xFF\xFE\x3D\xD8"s + "a\0"s) == mark + "a");  // half a pair
    CHECK(utf16ToUtf8("\xFF\xFE\x00\xDE\x3D\xD8"s) == mark + mark);
    CHECK(utf16ToUtf8("\xFF\xFE"s) == "");
    for (const std::string& other :
         {"<a/>"s, ""s, "<"s, "<\0"s, "<\0\0\0"s, "\0\0\0<"s, "\xFF"s, "\xEF\xBB\xBF<"s})
        CHECK_FALSE(utf16ToUtf8(other));
}
