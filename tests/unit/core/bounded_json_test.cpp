// JSON from outside: limits hold while the text is read, whatever it describes.
#include "core/bounded_json.h"

#include <malloc.h>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace farol;

namespace {

constexpr std::size_t kMiB = std::size_t{1} << 20U;
constexpr JsonLimits kSmall{.bytes = 4'096, .depth = 3, .keys = 4, .values = 20, .stringBytes = 16};

std::string repeated(const std::string& text, std::size_t count) {
    std::string out;
    out.reserve(text.size() * count);
    for (std::size_t i = 0; i < count; ++i) out += text;
    return out;
}

/// "done", or the reason and the message.
std::string outcome(const std::string& text, const JsonLimits& limits = kSmall) {
    try {
        parseJson(text, limits);
        return "done";
    } catch (const JsonError& error) {
        static constexpr const char* kReasons[] = {"syntax", "limit", "duplicate"};
        return std::string(kReasons[static_cast<std::size_t>(error.reason())]) + ": " +
               error.what();
    }
}

/// Heap in use. The largest that the parse can hold is compared with it through the limits alone:
/// leftovers of a refused text show here.
std::size_t heapBytes() {
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

}  // namespace

TEST_CASE("JSON within its limits is the value that it describes") {
    const std::string text =
        R"({"a": [1, -2, 2.5, true, null], "b": {"c": "é"}, "d": 18446744073709551615})";
    CHECK(parseJson(text, kSmall) == nlohmann::json::parse(text));
    CHECK(parseOrderedJson(R"({"b": 1, "a": 2})", kSmall).dump() == R"({"b":1,"a":2})");
    CHECK(parseJson("7", kSmall) == 7);
    CHECK(parseJson("[[[]]]", kSmall).dump() == "[[[]]]");
}

TEST_CASE("JSON beyond a limit is refused with its place") {
    CHECK(outcome("[[[[]]]]") ==
          "limit: line 1, column 4: arrays and objects are nested deeper than 3 levels");
    CHECK(outcome("{\n \"a\": {\"b\": {\"c\": {}}}}") ==
          "limit: line 2, column 19: arrays and objects are nested deeper than 3 levels");
    CHECK(outcome("[" + repeated("1,", 20) + "1]").rfind("limit: line 1, column ", 0) == 0);
    CHECK(outcome("\"" + std::string(17, 'x') + "\"") ==
          "limit: line 1, column 19: a string or number of 17 bytes; at most 16 are allowed");
    CHECK(outcome("{\"" + std::string(17, 'x') + "\":1}").rfind("limit: ", 0) == 0);
    CHECK(outcome("0." + std::string(20, '1')).rfind("limit: ", 0) == 0);
    CHECK(outcome(R"({"a":1,"b":2,"c":3,"d":4,"e":5})") ==
          "limit: line 1, column 28: an object has more than 4 keys");
    CHECK(outcome(std::string(4'097, ' ')) ==
          "limit: line 1, column 1: the text has 4097 bytes; at most 4096 are allowed");
}

TEST_CASE("JSON with a duplicate key, a number beyond a double or wrong syntax is refused") {
    CHECK(outcome(R"({"a": 1, "a": 2})") ==
          "duplicate: line 1, column 12: the key \"a\" occurs twice");
    CHECK(outcome(R"({"a": {"b": 1}, "b": 2})") == "done");
    CHECK(outcome("1e999").find("syntax: ") == 0);
    CHECK(outcome("-1e999").find("the number is out of range") != std::string::npos);
    for (const char* text : {"", " ", "{", "[1,]", "{\"a\"}", "nan", "1 2", "\"\xFF\"", "[1", "'a'",
                             "{\"a\":1}}", "\"\\ud800\"", "01", "\xEF\xBB"})
        CHECK(outcome(text).rfind("syntax: line 1, column ", 0) == 0);
}

TEST_CASE("a text of many megabytes leaves no trace of its size, whatever it nests or repeats") {
    const std::string texts[] = {
        std::string(16 * kMiB, '['),
        repeated("{\"a\":", 3 * kMiB),
        "\"" + std::string(16 * kMiB, 'x') + "\"",
        "[" + repeated("1,", 8 * kMiB) + "1]",
        "[" + repeated("{},", 5 * kMiB) + "1]",
        std::string(16 * kMiB, '1'),
    };
    // Limits of everything but the one that each text is about.
    const JsonLimits wide{.bytes = 64 * kMiB, .stringBytes = 64};
    for (const std::string& text : texts) {
        const std::size_t before = heapBytes();
        CHECK(outcome(text, wide) != "done");
        CHECK(heapBytes() <= before + kMiB);
    }
}
