#include <catch2/catch.hpp>

#include "tests/unit/scene/reading.h"

using namespace farol;
using namespace farol::scene;
using namespace farol::scene::test;

namespace {

std::string repeated(const std::string& text, int count) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
}

std::string codeOf(const std::string& xml, const ReadOptions& options = {}) {
    const Outcome outcome = tryRead(xml, options);
    if (outcome.scene) return "";
    for (const Diagnostic& one : outcome.diagnostics)
        if (one.severity == Severity::error) return one.code;
    return "no error";
}

}  // namespace

TEST_CASE("nesting, elements and bytes are bounded") {
    CHECK(codeOf("<world>" + repeated("<group>", 100'000)) == "limit.depth");
    CHECK(codeOf("<world>" + repeated("<group>", 100'000) + repeated("</group>", 100'000) +
                 "</world>") == "limit.bytes");
    ReadOptions large;
    large.limits.bytes = 1 << 24;
    CHECK(codeOf(
              "<world>" + repeated("<group>", 100'000) + repeated("</group>", 100'000) + "</world>",
              large) == "limit.depth");
    CHECK(codeOf(world(repeated("<group/>", 50'001))) == "limit.elements");
    CHECK(codeOf(world(repeated("<group/>", 49'999))).empty());
    CHECK(codeOf(world(repeated(" ", 1 << 20))) == "limit.bytes");

    ReadOptions tight;
    tight.limits.depth = 3;
    CHECK(codeOf("<world><group><group/></group></world>", tight).empty());
    CHECK(codeOf("<world><group><group><group/></group></group></world>", tight) == "limit.depth");
    // Whatever the caller allows, recursion stays within the stack.
    large.limits.depth = 1'000'000;
    CHECK(codeOf("<world>" + repeated("<group>", 100'000), large) == "limit.depth");
    CHECK(codeOf(world(repeated("<group>", 400) + repeated("</group>", 400)), large).empty());
}

TEST_CASE("at most 50 findings a document, errors before warnings") {
    const std::string warnings = repeated("<grop/>", 200);
    const Outcome many = tryRead(world(warnings));
    REQUIRE(many.scene);
    CHECK(many.diagnostics.size() == 50);
    CHECK(many.diagnostics.back().code == "limit.diagnostics");
    const Outcome refused =
        tryRead(world(warnings + "<group><transform><translate x=\"a\"/></transform></group>"));
    REQUIRE_FALSE(refused.scene);
    CHECK(refused.diagnostics.size() == 50);
    CHECK(refused.find("scene.number") != nullptr);
    CHECK(tryRead(world(repeated("<grop/>", 50))).diagnostics.size() == 50);
    CHECK(tryRead(world(repeated("<grop/>", 50))).find("limit.diagnostics") == nullptr);
}

TEST_CASE("repeated repairs are told a few times, then counted") {
    const Outcome outcome = tryRead(scene2017(repeated("<group><translate x=1 y=2/></group>", 20)));
    REQUIRE(outcome.scene);
    CHECK(outcome.diagnostics.size() == 6);
    CHECK_THAT(outcome.diagnostics.back().message, Catch::StartsWith("35 more"));
}

TEST_CASE("hostile texts take time in proportion to their length") {
    // Each of these is quadratic in a careless reader: a megabyte would then take minutes, and
    // the test's own time limit would end it.
    for (const std::string& unit :
         {std::string("&"), std::string("<"), std::string("<!"), std::string("<?"),
          std::string("< "), std::string("</a>"), std::string("<!--"), std::string("<![CDATA["),
          std::string("<a b="), std::string("<a b=\"'"), std::string("/ "), std::string("=\"")}) {
        INFO(unit);
        const int count = static_cast<int>((1 << 20) / unit.size()) - 20;
        CHECK_FALSE(codeOf("<world><title>" + repeated(unit, count)).empty());
        CHECK_FALSE(codeOf("<world a=\"" + repeated(unit, count)).empty());
    }
}

TEST_CASE("messages quote a bounded part of the document") {
    const std::string longName(100'000, 'n');
    for (const std::string& xml :
         {"<" + longName + "/>", world("<" + longName + "/>"),
          transform("<translate " + longName + "=\"1\"/>"),
          transform("<translate x=\"" + longName + "\"/>"), world("</" + longName + ">"),
          light("type=\"" + longName + "\"")}) {
        const Outcome outcome = tryRead(xml);
        REQUIRE_FALSE(outcome.diagnostics.empty());
        for (const Diagnostic& one : outcome.diagnostics) CHECK(one.message.size() < 400);
    }
}
