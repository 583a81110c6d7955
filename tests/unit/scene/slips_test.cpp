// Slips of real scenes that student engines draw all the same: the reading, and the warning.
#include <catch2/catch.hpp>
#include <functional>

#include "tests/unit/scene/reading.h"

using namespace farol;
using namespace farol::scene;
using namespace farol::scene::test;

namespace {

const Diagnostic& finding(const Outcome& outcome, const std::string& code) {
    INFO(outcome.text());
    const Diagnostic* found = outcome.find(code);
    REQUIRE(found != nullptr);
    return *found;
}

bool isClean(const Outcome& outcome) {
    return std::none_of(outcome.diagnostics.begin(), outcome.diagnostics.end(),
                        [](const Diagnostic& one) { return one.severity != Severity::info; });
}

glm::dvec3 scaleOf(const std::string& x) {
    const Outcome outcome = tryRead(transform("<scale x=\"" + x + "\" y=\"1\" z=\"1\"/>"));
    INFO(outcome.text());
    REQUIRE(outcome.scene);
    CHECK(finding(outcome, "scene.number").severity == Severity::warning);
    return std::get<Scale>(outcome.scene->groups.at(0).transforms.at(0)).factors;
}

ReadOptions leavingOut() {
    ReadOptions options;
    options.leaveOut = true;
    return options;
}

}  // namespace

TEST_CASE("the number that begins a value is read, with a warning that names it") {
    CHECK(scaleOf("1,").x == 1.0);
    CHECK(scaleOf("1,5").x == 1.5);
    CHECK(scaleOf("1.5´").x == 1.5);
    CHECK(scaleOf("1.5-").x == 1.5);
    CHECK(scaleOf("− 2").x == -2.0);
    const Outcome outcome = tryRead(transform("<scale x=\"0,48\"/>"));
    CHECK_THAT(finding(outcome, "scene.number").message, Catch::Contains("using 0.48"));
    ReadOptions strict;
    strict.strict = true;
    CHECK_FALSE(tryRead(transform("<scale x=\"0,48\"/>"), strict).scene);
    const Outcome window = tryRead("<world><window width=\"300.7\"/></world>");
    REQUIRE(window.scene);
    CHECK(window.scene->window->width == 300);
}

TEST_CASE("the generator is called by other names, and its file stands behind a mark") {
    for (const char* comment :
         {"./gerador sphere 1 8 8 a.3d", "generate sphere 1 8 8 a.3d",
          "python3 generator.py sphere 1 8 8 a.3d", "generator \"sphere\" 1 8 8 \"a.3d\"",
          "./generator sphere 1 8 8 > a.3d", "gen sphere 1 8 8 -o a.3d"}) {
        CAPTURE(comment);
        const Outcome outcome = tryRead("<!-- " + std::string(comment) + " --><world/>");
        REQUIRE(outcome.scene);
        const auto& comments = outcome.scene->generatorComments;
        REQUIRE(comments.count("a.3d") == 1);
        CHECK(comments.at("a.3d") == std::vector<std::string>{"sphere", "1", "8", "8"});
    }
    for (const char* other : {"a gene > a.3d", "generator sphere 1 > 2 > a.3d", "gen <a> 1 a.3d"})
        CHECK(tryRead("<!-- " + std::string(other) + " --><world/>")
                  .scene.value()
                  .generatorComments.empty());
}

TEST_CASE("NUL bytes behind a document are left out") {
    CHECK(isClean(tryRead(model("") + std::string(3, '\0'))));
}

TEST_CASE("a length that must be over 0 and is too small becomes the smallest, with a warning") {
    const Outcome tiny = tryRead(camera("<position z=\"5\"/><projection near=\"1e-10\"/>"));
    REQUIRE(tiny.scene);
    CHECK_THAT(finding(tiny, "scene.clamped").message, Catch::Contains("expected 1e-09 or more"));
    CHECK(tiny.scene->camera->near == 1e-9);
    for (const char* none : {"0", "-1", "-1e-10"}) {
        const std::string near = std::string("<projection near=\"") + none + "\"/>";
        CHECK_FALSE(tryRead(camera("<position z=\"5\"/>" + near)).scene);
    }
}

TEST_CASE("an unknown attribute is a warning in every dialect where another is understood") {
    for (const std::string& xml :
         {scene2017("<group><translate z=\"5\" sped=\"2\"/></group>"),
          scene2020("<group><rotate angle=\"5\" y=\"1\" speed=\"2\"/></group>"),
          transform("<scale x=\"2\" factor=\"2\"/>"), group("<models speed=\"2\"/>")}) {
        const Outcome outcome = tryRead(xml);
        CHECK(outcome.scene);
        CHECK(finding(outcome, "scene.unknown-attribute").severity == Severity::warning);
    }
    CHECK_THAT(
        finding(tryRead(scene2017("<translate x=\"1\" tiem=\"2\"/>")), "scene.unknown-attribute")
            .message,
        Catch::Contains("\"time\""));
    for (const std::string& xml :
         {scene2017("<translate w=4/>"), transform("<scale factor=\"2\"/>")})
        CHECK(finding(tryRead(xml), "scene.unknown-attribute").severity == Severity::error);
}

TEST_CASE("a rotation about no axis or in no time turns nothing") {
    for (const std::string& xml :
         {transform("<rotate angle=\"180\" x=\"0\" y=\"\" z=\"\"/>"),
          scene2017("<rotate angle=\"5\"/>"), transform("<rotate time=\"5\"/>")}) {
        const Outcome outcome = tryRead(xml);
        CHECK(outcome.scene);
        CHECK(finding(outcome, "scene.zero-direction").severity == Severity::warning);
    }
    const Outcome still = tryRead(transform("<rotate time=\"0\" y=\"1\"/>"));
    REQUIRE(still.scene);
    CHECK(still.scene->groups.at(0).transforms.empty());
    CHECK(finding(still, "scene.range").severity == Severity::warning);
    const Outcome curve = tryRead(
        transform("<translate time=\"0\"><point x=\"3\"/><point/><point/><point/></translate>"));
    REQUIRE(curve.scene);
    CHECK(std::get<Translate>(curve.scene->groups.at(0).transforms.at(0)).offset.x == 3.0);
}

TEST_CASE("of several roots the first that is a scene's is read") {
    const Outcome outcome =
        tryRead("<settings><vsync on=\"false\"/></settings>\n" + model("") + "\n" + world(""));
    REQUIRE(outcome.scene);
    CHECK(outcome.scene->groups.size() == 1);
    std::vector<int> lines;
    for (const Diagnostic& one : outcome.diagnostics)
        if (one.code == "xml.extra-root") lines.push_back(one.where.line);
    CHECK(lines == std::vector<int>{1, 3});
    CHECK_FALSE(tryRead("<a/><b/>").scene);
}

TEST_CASE("parts of a scene are read as the content of a world") {
    for (const std::string& xml :
         {std::string("<group><models><model file=\"a.3d\"/></models></group>"),
          std::string("<models><model file=\"a.3d\"/></models>"),
          std::string("<model file=\"a.3d\"/>")}) {
        const Outcome outcome = tryRead(xml);
        REQUIRE(outcome.scene);
        CHECK(outcome.scene->groups.size() == 1);
        CHECK(finding(outcome, "scene.root").severity == Severity::warning);
    }
}

TEST_CASE("documents of other programs are refused by name") {
    struct Case {
        const char* xml;
        const char* name;
    };
    const Case one = GENERATE(values<Case>({
        {"<Scene><Cameras/><Vertices>0 0</Vertices><Objects/></Scene>", "ray tracer"},
        {"<Scene><Lights/><VertexData>0 0</VertexData></Scene>", "ray tracer"},
        {"<scene version=\"2.0\"><integrator/><sensor/><shape/></scene>", "Mitsuba"},
        {"<X3D><Scene><Shape/></Scene></X3D>", "X3D"},
        {"<COLLADA><library_geometries/><scene/></COLLADA>", "COLLADA"},
        {"<svg xmlns=\"http://www.w3.org/2000/svg\"><g/></svg>", "SVG"},
        {"<!DOCTYPE html>\n<html><body><br></body></html>", "HTML"},
        {"<scene formatVersion=\"1.0\"><nodes/><environment/></scene>", "OGRE"},
        {"<robot name=\"r\"><link/></robot>", "robot"},
        {"<mxfile><diagram/></mxfile>", "draw.io"},
        {"<dae:COLLADA/>", "COLLADA"},
        {"<scene><widget/><panel/></scene>", "another program"},
    }));
    const Outcome outcome = tryRead(one.xml);
    INFO(one.xml << "\n" << outcome.text());
    CHECK_FALSE(outcome.scene);
    REQUIRE(outcome.diagnostics.size() == 1);
    CHECK_THAT(outcome.diagnostics[0].message, Catch::Contains(one.name));
    // Placeholders stand for parts of a scene, not for one.
    CHECK_FALSE(tryRead(one.xml, leavingOut()).scene);
}

TEST_CASE("a scene with a misspelt element is no other program's") {
    const Outcome outcome = tryRead(world("<grop/>"));
    CHECK(outcome.scene);
    CHECK(outcome.find("scene.empty") != nullptr);
}

TEST_CASE("a scene without camera is left to be framed in every dialect, engine start on demand") {
    const std::string body = "<group><models><model file=\"a.3d\"/></models></group>";
    CHECK_FALSE(tryRead(world(body)).scene->camera);
    CHECK_FALSE(tryRead(scene2017(body)).scene->camera);
    CHECK_FALSE(tryRead(scene2020(body)).scene->camera);
    const Outcome engine = tryRead("<scene camera=\"engine\">" + body + "</scene>");
    REQUIRE(engine.scene->camera);
    CHECK(engine.scene->camera->eye == glm::dvec3(0.0));
    CHECK(engine.scene->camera->target == glm::dvec3(0, 0, 1));
    CHECK(engine.scene->camera->fovDeg == 45.0);
    CHECK(finding(engine, "scene.camera-start").severity == Severity::info);
}

TEST_CASE("each generator command of a line ends at its .3d") {
    const auto comments = [](const std::string& text) {
        return tryRead("<!-- " + text + " -->" + world("")).scene->generatorComments;
    };
    using Words = std::vector<std::string>;
    auto found = comments("./generator ring 1 2 24 1 loop.3d    ./generator sphere 1 16 8 ball.3d");
    CHECK(found["loop.3d"] == Words{"ring", "1", "2", "24", "1"});
    CHECK(found["ball.3d"] == Words{"sphere", "1", "16", "8"});
    found = comments("generator box 1 a.3d, cone 1 2 8 4 b.3d plane 2 c.3d");
    CHECK(found["a.3d"] == Words{"box", "1"});
    CHECK(found["b.3d"] == Words{"cone", "1", "2", "8", "4"});
    CHECK(found["c.3d"] == Words{"plane", "2"});
    found = comments("generator patch teapot.patch 10 pot.3d");
    CHECK(found["pot.3d"] == Words{"patch", "teapot.patch", "10"});
    CHECK(comments("see ball.3d and the generator of last year").empty());
}

TEST_CASE("an include stands anywhere, and may name a part of a scene") {
    const std::map<std::string, std::string> files = {
        {"lamp.xml", model("")}, {"part.xml", "<group><model file=\"b.3d\"/></group>"}};
    const auto models = [&](const std::string& xml) {
        const Outcome outcome = tryRead(xml, {}, files);
        INFO(outcome.text());
        REQUIRE(outcome.scene);
        std::size_t count = 0;
        const std::function<void(const Group&)> visit = [&](const Group& one) {
            count += one.models.size();
            for (const Group& child : one.groups) visit(child);
        };
        for (const Group& one : outcome.scene->groups) visit(one);
        return count;
    };
    CHECK(models(group("<include file=\"lamp.xml\"/>")) == 1);
    CHECK(models(world("<include file=\"lamp.xml\"/>")) == 1);
    CHECK(models(group("<models><include file=\"lamp.xml\"/></models>")) == 1);
    CHECK(models(group("<xml file=\"part.xml\"/>")) == 1);
}

TEST_CASE("the colour of a group or transform is that of its models without colours") {
    const std::string two =
        "<models><model file=\"a.3d\"/>"
        "<model file=\"b.3d\"><color><diffuse R=\"9\" G=\"0\" B=\"0\"/></color></model></models>";
    for (const std::string& xml :
         {group("<color r=\"0\" g=\"1\" b=\"0.5\"/>" + two + "<group>" + two + "</group>"),
          group("<transform><color R=\"0\" G=\"255\" B=\"127.5\"/></transform>" + two + "<group>" +
                two + "</group>")}) {
        const Outcome outcome = tryRead(xml);
        INFO(outcome.text());
        REQUIRE(outcome.scene);
        CHECK(isClean(outcome));
        const Group& outer = outcome.scene->groups.at(0);
        CHECK(outer.models.at(0).material->diffuse.rgb == glm::vec3(0.0F, 1.0F, 0.5F));
        CHECK(outer.models.at(1).material->diffuse.rgb.x == Approx(9.0 / 255.0));
        CHECK(outer.groups.at(0).models.at(0).material->diffuse.rgb == glm::vec3(0.0F, 1.0F, 0.5F));
    }
    // Not beyond the group, and lines stay lines.
    const Outcome lines =
        tryRead(world("<group><color r=\"1\" g=\"0\" b=\"0\"/><model file=\"a.3d\"/></group>"
                      "<group><model file=\"a.3d\"/></group>"));
    CHECK(lines.scene->settings.shading == Shading::wireframe);
    CHECK_FALSE(lines.scene->groups.at(1).models.at(0).material);
    const Outcome lit =
        tryRead(world("<lights><light type=\"point\" posX=\"1\"/></lights>"
                      "<group><color r=\"1\" g=\"0\" b=\"0\"/><model file=\"a.3d\"/></group>"));
    CHECK_FALSE(lit.scene->settings.shading);
}

TEST_CASE("slips of colours are read as meant") {
    const auto diffuse = [](const std::string& xml, const std::string& code) {
        const Outcome outcome = tryRead(xml);
        INFO(outcome.text());
        REQUIRE(outcome.scene);
        if (code.empty())
            CHECK(isClean(outcome));
        else
            CHECK(finding(outcome, code).severity == Severity::warning);
        return outcome.scene->groups.at(0).models.at(0).material.value().diffuse.rgb;
    };
    const glm::vec3 orange(1.0F, 136.0F / 255.0F, 0.0F);
    const auto with = [](const std::string& attribute) {
        return group("<model file=\"a.3d\" " + attribute + "/>");
    };
    CHECK(diffuse(model("<color R=\"255\" G=\"136\" B=\"0\"/>"), "scene.misplaced") == orange);
    CHECK(diffuse(with("color=\"#ff8800\""), "") == orange);
    CHECK(diffuse(with("diffuse=\"ff8800\""), "scene.value") == orange);
    CHECK(diffuse(with("diffuse=\"#ff8800\""), "") == orange);
    CHECK(diffuse(with("diffuse=\"0xFF8800\""), "scene.value") == orange);
    CHECK(diffuse(with("diffuse=\"#ff8800ff\""), "scene.value") == orange);
    CHECK(diffuse(with("diffuse=\"rgb(255, 136, 0)\""), "scene.value") == orange);
    CHECK(diffuse(with("diffuse=\"1 0.5 0\""), "scene.color-scale").y == Approx(0.5));
    const Outcome background = tryRead(world("<background color=\"0.2,0.4,0.6\"/>"));
    CHECK(background.scene->background.color->z == Approx(0.6));
    CHECK(
        tryRead(world("<background r=\"0.2\" g=\"0.4\" b=\"0.6\"/>")).scene->background.color->z ==
        Approx(0.6));
}

TEST_CASE("a child in the wrong parent is reported with the nearest right one") {
    const auto message = [](const std::string& xml) {
        return finding(tryRead(xml), "scene.misplaced").message;
    };
    CHECK_THAT(message(model("<diffuse R=\"9\"/>")), Catch::Contains("<color>"));
    CHECK_THAT(message(transform("<model file=\"a.3d\"/>")), Catch::Contains("<models>"));
    CHECK_THAT(message(camera("<rotate angle=\"9\" y=\"1\"/>")), Catch::Contains("<transform>"));
    CHECK_THAT(message(world("<position x=\"1\"/>")), Catch::Contains("<camera>"));
}

TEST_CASE("tracking draws as without it, with one note") {
    const std::string curve =
        "<translate time=\"5\" tracking=\"true\"><point/><point x=\"1\"/><point y=\"1\"/><point "
        "z=\"1\"/></translate>";
    const Outcome outcome =
        tryRead(world("<group><transform>" + curve + "</transform></group><group><transform>" +
                      curve + "</transform><model file=\"a.3d\"/></group>"));
    REQUIRE(outcome.scene);
    CHECK(isClean(outcome));
    CHECK(std::count_if(outcome.diagnostics.begin(), outcome.diagnostics.end(),
                        [](const Diagnostic& one) { return one.code == "scene.ineffective"; }) ==
          1);
    CHECK(std::get<FollowCurve>(outcome.scene->groups.at(0).transforms.at(0)).points.size() == 4);
}

TEST_CASE("a document type without definitions is ignored, one with them refused") {
    CHECK(tryRead("<!DOCTYPE world SYSTEM \"world.dtd\">" + model("")).scene);
    CHECK_FALSE(tryRead("<!DOCTYPE world [<!ENTITY a \"b\">]>" + model("")).scene);
}

TEST_CASE("of a merge conflict the first version is read, at its own lines") {
    const std::string xml =
        "<world>\n<<<<<<< HEAD\n<group name=\"ours\"/>\n||||||| base\n<group name=\"base\">\n"
        "=======\n<group name=\"theirs\">\n>>>>>>> feature\n<grop/>\n</world>";
    const Outcome outcome = tryRead(xml);
    INFO(outcome.text());
    REQUIRE(outcome.scene);
    REQUIRE(outcome.scene->groups.size() == 1);
    CHECK(outcome.scene->groups[0].name == "ours");
    CHECK(finding(outcome, "xml.conflict").where.line == 2);
    CHECK(finding(outcome, "scene.unknown-element").where.line == 9);
}

TEST_CASE("with leaveOut an unclosed element ends where its parent ends") {
    const std::string xml =
        "<world><group><transform><translate x=\"1\"><rotate angle=\"9\" y=\"1\"/>"
        "<models><model file=\"a.3d\"></models></group>"
        "<group><models><model file=\"b.3d\"/></models></group></world>";
    CHECK_FALSE(tryRead(xml).scene);
    const Outcome outcome = tryRead(xml, leavingOut());
    INFO(outcome.text());
    REQUIRE(outcome.scene);
    CHECK(finding(outcome, "xml.unclosed").severity == Severity::error);
    REQUIRE(outcome.scene->groups.size() == 2);
    CHECK(outcome.scene->groups[0].transforms.size() == 2);
    CHECK(outcome.scene->groups[0].models.size() == 1);
    CHECK(outcome.scene->groups[1].models.size() == 1);
}

TEST_CASE("with leaveOut errors leave out what they concern, and stay in the list") {
    const Outcome outcome = tryRead(
        world("<camera><position x=\"1\"/><lookAt x=\"1\"/></camera>"
              "<lights><light type=\"laser\"/><light type=\"point\" posX=\"1\"/></lights>"
              "<group><transform><translate x=\"abc\"/><scale x=\"2\"/></transform>"
              "<models><model/><model file=\"a.3d\"/></models><xml file=\"no.xml\"/></group>"),
        leavingOut());
    INFO(outcome.text());
    REQUIRE(outcome.scene);
    CHECK_FALSE(outcome.scene->camera);
    CHECK(outcome.scene->lights.size() == 1);
    CHECK(outcome.scene->groups.at(0).transforms.size() == 1);
    CHECK(outcome.scene->groups.at(0).models.size() == 1);
    for (const char* code : {"scene.camera", "scene.value", "scene.number",
                             "scene.missing-attribute", "asset.missing"})
        CHECK(finding(outcome, code).severity == Severity::error);
    // A text that is no document has nothing to leave out.
    for (const char* nothing : {"", "{}", "<word/>"})
        CHECK_FALSE(tryRead(nothing, leavingOut()).scene);
}
