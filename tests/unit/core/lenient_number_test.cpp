#include "core/lenient_number.h"

#include <catch2/catch.hpp>

using farol::leadingNumber;

TEST_CASE("a number is read as engines and authors read it") {
    struct Case {
        const char* text;
        double value;
    };
    const Case one = GENERATE(values<Case>({
        {"1,", 1},
        {"3.55´", 3.55},
        {"4245.-", 4245},
        {"1.5-", 1.5},
        {"0,48", 0.48},
        {"-0,5", -0.5},
        {",5", 0.5},
        {"1.000,5", 1000.5},
        {"1.234.567,25", 1234567.25},
        {"1,000.5", 1000.5},
        {"1,234,567", 1234567},
        {"1,234", 1.234},
        {"1,2,3", 1},
        {"+ 1", 1},
        {"- 2.5", -2.5},
        {"\u22121.5", -1.5},
        {"\u20133", -3},
        {"1e", 1},
        {"2e+", 2},
        {"1e\u22122", 0.01},
        {"1.5f", 1.5},
        {"1.5ff", 1.5},
        {"90deg", 90},
        {"90°", 90},
        {"45%", 45},
        {"5 s", 5},
        {"1 2", 1},
        {"1.2.3", 1.2},
        {"1px", 1},
        {"1/2", 1},
        {"\u00A07", 7},
        {"1.", 1},
        {"1e3x", 1000},
        {"1,5e2", 150},
        {"0,0", 0},
        {"1.000", 1},
        {"12;", 12},
        {"1'000", 1},
    }));
    CAPTURE(one.text);
    const farol::ParsedNumber read = leadingNumber(one.text);
    CHECK(read.problem.empty());
    CHECK(read.value == Approx(one.value).epsilon(1e-12));
}

TEST_CASE("a text that no number begins stays refused") {
    for (const char* text :
         {"",    " ",         "abc",   "--1",  "+-1",    "- - 1",   "NaN", "nan(ind)",
          "inf", "-Infinity", "1e999", "1e19", "0x10",   "-0x1p3",  ".",   "-",
          "-.",  ",",         "e5",    "1 y=", "\u2212", "\xFF\xFE"}) {
        CAPTURE(text);
        CHECK_FALSE(leadingNumber(text).problem.empty());
    }
}
