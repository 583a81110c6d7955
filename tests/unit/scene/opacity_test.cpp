#include <catch2/catch.hpp>
#include <functional>
#include <vector>

#include "tests/unit/scene/reading.h"

using namespace farol;
using namespace farol::scene;
using namespace farol::scene::test;

TEST_CASE("opacity by an attribute, a colour, and a name") {
    const auto model = [](const std::string& attributes, const std::string& content = "") {
        return world(
            "<colors><color name=\"ice\" r=\"0.5\" a=\"0.4\"/></colors><group><models>"
            "<model command=\"box 1\" " +
            attributes + ">" + content + "</model></models></group>");
    };
    const auto ofModel = [](const Scene& s) { return double{s.groups[0].models[0].opacity}; };
    const auto ofMaterial = [](const Scene& s) {
        return double{s.groups[0].models[0].material->opacity};
    };
    struct Row {
        std::string xml;
        std::function<double(const Scene&)> value;
        double expected;
    };
    const std::vector<Row> rows{
        {model(""), ofModel, 1},
        {model("opacity=\"0.25\""), ofModel, 0.25},
        {model("opacity=\"50%\""), ofModel, 0.5},
        {model("", "<color><diffuse R=\"9\" A=\"50%\"/></color>"), ofMaterial, 0.5},
        {model("diffuse=\"ice\""), ofMaterial, double{0.4F}},
        {model("diffuse=\"red\" ambient=\"ice\""), ofMaterial, 1},
        {model("", "<color><diffuse R=\"9\"/></color>"), ofMaterial, 1},
        {model("", "<color><diffuse R=\"9\" A=\"51\"/></color>"), ofMaterial, double{0.2F}},
        {model("", "<color><diffuse R=\"9\" alpha=\"0.5\"/></color>"), ofMaterial, 0.5},
        {model("", "<color A=\"0.5\"><diffuse R=\"9\"/></color>"), ofMaterial, 0.5},
        {model("", "<color><ambient R=\"9\" A=\"51\"/></color>"), ofMaterial, 1},
    };
    for (const Row& row : rows) {
        INFO(row.xml);
        const Outcome outcome = tryRead(row.xml);
        REQUIRE(outcome.scene);
        CHECK(row.value(*outcome.scene) == row.expected);
    }
    CHECK(ofModel(*tryRead(model("opacity=\"50\"")).scene) == 1.0);  // clamped, with a warning
    CHECK(tryRead(model("opacity=\"0\"")).find("scene.value") != nullptr);
    CHECK(ofMaterial(*tryRead(model("diffuse=\"rgba(255, 0, 0, 0.5)\"")).scene) == 0.5);
    CHECK(ofMaterial(*tryRead(model("diffuse=\"#ff000033\"")).scene) == Approx(0.2));
    const Outcome group =
        tryRead(world("<group><color><diffuse R=\"200\" A=\"102\"/></color><models><model "
                      "command=\"box 1\"/></models></group>"));
    CHECK(ofMaterial(*group.scene) == Approx(0.4));
}
