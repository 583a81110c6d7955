#include <catch2/catch.hpp>

#include "tests/unit/scene/reading.h"

using namespace farol;
using namespace farol::scene;
using namespace farol::scene::test;

namespace {

using Files = std::map<std::string, std::string>;

std::string include(const std::string& file) { return "<xmls><xml file=\"" + file + "\"/></xmls>"; }

}  // namespace

TEST_CASE("included scenes become part of the scene") {
    const Files files = {
        {"moon.xml", "<scene><translate x=2/><models><model file=\"m.3d\"/></models></scene>"},
        {"lit.xml", world("<lights><light type=\"point\"/></lights>" + std::string("<group/>"))}};
    const Outcome root = tryRead(world(include("moon.xml") + include("lit.xml")), {}, files);
    INFO(root.text());
    REQUIRE(root.scene);
    REQUIRE(root.scene->groups.size() == 2);
    CHECK(root.scene->groups[0].models[0].file == "m.3d");
    CHECK(root.scene->lights.size() == 1);

    const Outcome inner = tryRead(group(include("lit.xml")), {}, files);
    REQUIRE(inner.scene);
    CHECK(inner.scene->lights.empty());
    CHECK(inner.scene->groups[0].groups[0].lights.size() == 1);

    const Outcome list = tryRead(include("moon.xml"), {}, files);
    REQUIRE(list.scene);
    CHECK(list.scene->groups.size() == 1);
}

TEST_CASE("faults of an included scene carry its name") {
    const Files files = {{"bad.xml",
                          "<world>\n <group><transform><scale x='a'/>"
                          "</transform></group></world>"}};
    const Outcome outcome = tryRead(world(include("bad.xml")), {}, files);
    REQUIRE_FALSE(outcome.scene);
    CHECK(outcome.diagnostics[0].where == Location{"bad.xml", 2, 30});
    CHECK(outcome.diagnostics[0].code == "scene.number");
    const Outcome empty = tryRead(world(include("e.xml")), {}, {{"e.xml", ""}});
    CHECK(empty.find("xml.empty") != nullptr);
}

TEST_CASE("includes stay inside the bundle, end, and share the limits") {
    const auto code = [](const std::string& xml, const Files& files,
                         const ReadOptions& options = {}) {
        const Outcome outcome = tryRead(xml, options, files);
        return outcome.scene ? std::string() : outcome.diagnostics.front().code;
    };
    CHECK(code(world(include("../x.xml")), {}) == "asset.missing");
    CHECK(code(world(include("/etc/passwd")), {}) == "asset.missing");
    CHECK(code(world(include("a.xml")), {{"a.xml", world(include("a.xml"))}}) ==
          "scene.include-cycle");
    CHECK(code(world(include("a.xml")),
               {{"a.xml", world(include("b.xml"))}, {"b.xml", world(include("a.xml"))}}) ==
          "scene.include-cycle");
    Files chain;
    for (int i = 0; i < 20; ++i)
        chain["f" + std::to_string(i) + ".xml"] =
            world(include("f" + std::to_string(i + 1) + ".xml"));
    CHECK(code(world(include("f0.xml")), chain) == "limit.includes");
    std::string many;
    for (int i = 0; i < 65; ++i) many += include("one.xml");
    CHECK(code(world(many), {{"one.xml", "<world/>"}}) == "limit.includes");
    ReadOptions few;
    few.limits.elements = 10;
    CHECK(code(world(include("g.xml")), {{"g.xml", world("<group/><group/>")}}, few).empty());
    CHECK(code(world(include("g.xml") + include("g.xml")), {{"g.xml", world("<group/><group/>")}},
               few) == "limit.elements");
}

TEST_CASE("an included file names its neighbours from its own folder") {
    const Files files = {{"parts/a.xml", world(include("b.xml"))},
                         {"parts/b.xml", world("<group name=\"beside\"/>")},
                         {"b.xml", world("<group name=\"above\"/>")}};
    const Outcome outcome = tryRead(world(include("parts/a.xml")), {}, files);
    INFO(outcome.text());
    REQUIRE(outcome.scene);
    CHECK(outcome.scene->groups.at(0).name == "beside");
}

TEST_CASE("an entity is a separate scene") {
    const Files files = {{"ship.xml", "<scene><models><model file=\"s.3d\"/></models></scene>"}};
    const Outcome outcome = tryRead(scene2017("<entity file=ship.xml/>"), {}, files);
    INFO(outcome.text());
    REQUIRE(outcome.scene);
    REQUIRE(outcome.scene->entity);
    CHECK(outcome.scene->entityFile == "ship.xml");
    CHECK(outcome.scene->entity->groups.at(0).models.at(0).file == "s.3d");
    CHECK(outcome.scene->entity->globalAmbient.r == Approx(0.2F));
    CHECK(outcome.scene->groups.empty());
}
