#include <catch2/catch.hpp>
#include <ctime>

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
    // Recursion stays within the stack, whatever the caller allows.
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
    const std::string some = world(repeated("<grop/>", 50) + "<background color=\"red\"/>");
    CHECK(tryRead(some).diagnostics.size() == 50);
    CHECK(tryRead(some).find("limit.diagnostics") == nullptr);
}

TEST_CASE("repeated repairs are reported a few times, then counted") {
    const Outcome outcome = tryRead(scene2017(repeated("<group><translate x=1 y=2/></group>", 20) +
                                              "<background color=\"red\"/>"));
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

TEST_CASE("siblings and names take time in proportion to their number") {
    // Each of these compared every element with every other; they take 0.1 s now, where the
    // squares of their numbers took seconds to minutes.
    const double kSeconds = 3;
    const auto seconds = [](const std::string& xml) {
        const std::clock_t begin = std::clock();
        tryRead(xml);
        return double(std::clock() - begin) / CLOCKS_PER_SEC;
    };
    const auto model = [](const std::string& content) {
        return world("<group><models><model file=\"box_1.3d\">" + content +
                     "</model></models></group>");
    };
    CHECK(seconds(model(repeated("<texgen/>", 49'990))) < kSeconds);
    CHECK(seconds(model(repeated("<texgen/>", 49'980) + "<texture file=\"a.png\"/>")) < kSeconds);
    std::string colors = "<colors>", named;
    for (int i = 0; i < 8'000; ++i) {
        const std::string name = std::string(58, 'a') + std::to_string(10'000 + i);
        colors += "<color name=\"" + name + "\"/>";
    }
    for (int i = 0; i < 3'000; ++i)
        named += "<model file=\"a\" diffuse=\"" + std::string(58, 'b') +
                 std::to_string(10'000 + i) + "\"/>";
    CHECK(seconds(world(colors + "</colors><group><models>" + named + "</models></group>")) <
          kSeconds);
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

TEST_CASE("scatters are refused by the product of their counts") {
    const auto nested = [](int first, int second, int third, const std::string& content) {
        const auto open = [](int count) {
            return "<group><scatter count=\"" + std::to_string(count) +
                   "\" xzMin=\"1\" xzMax=\"9\"/>\n";
        };
        return scene2017(open(first) + open(second) + open(third) + content +
                         "</group></group></group>");
    };
    const std::string model = "<models><model file=\"box_1.3d\"/></models>";
    CHECK(codeOf(nested(50, 40, 10, model)).empty());
    CHECK(codeOf(nested(50, 50, 50, "<translate x=\"1\"/>")).empty());
    for (const std::string& content :
         {model, std::string("<transform><translate x=\"1\"/></transform>"),
          std::string("<group/>"), std::string()}) {
        const Outcome outcome = tryRead(nested(5000, 5000, 5000, content));
        REQUIRE_FALSE(outcome.scene);
        const Diagnostic* found = outcome.find("limit.instances");
        REQUIRE(found != nullptr);
        CHECK(found->where.line > 0);
        CHECK_THAT(found->message, Catch::Contains("at most"));
    }
    // Scattered models nest too, and 60 levels of scatters are more than any number holds.
    CHECK(codeOf(nested(1000, 1000, 1,
                        "<models><model file=\"box_1.3d\" rand=\"1000\" xzMinR=\"1\" "
                        "xzMaxR=\"9\"/></models>")) == "limit.instances");
    CHECK(codeOf(scene2017(repeated("<group><scatter count=\"5000\" xzMax=\"9\"/>", 60) +
                           repeated("</group>", 60))) == "limit.instances");
    // Many scatters side by side add up.
    CHECK(codeOf(scene2017(
              repeated("<group><scatter count=\"5000\" xzMax=\"9\"/>" + model + "</group>", 50))) ==
          "limit.instances");
}
