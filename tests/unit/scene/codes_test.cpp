// Tables of inputs that are repaired or refused: the findings, their places, and whether a scene
// results.
#include <catch2/catch.hpp>

#include "tests/unit/scene/reading.h"

using namespace farol;
using namespace farol::scene;
using namespace farol::scene::test;

namespace {

struct CodeCase {
    std::string xml;  ///< "^" marks the expected place, and is removed before reading
    bool refused;
    std::string code;
};

/// Line and column of an offset, counted anew: the reader's own counting is under test.
std::string placeOf(const std::string& xml, std::size_t offset) {
    int line = 1, column = 1;
    for (std::size_t i = xml.substr(0, 3) == "\xEF\xBB\xBF" ? 3 : 0; i < offset; ++i) {
        const bool ends = xml[i] == '\n' || (xml[i] == '\r' && xml.substr(i + 1, 1) != "\n");
        line += ends ? 1 : 0;
        column = ends ? 1 : column + 1;
    }
    return std::to_string(line) + ":" + std::to_string(column);
}

void check(const std::vector<CodeCase>& cases) {
    for (const CodeCase& one : cases) {
        const std::size_t mark = one.xml.find('^');
        REQUIRE(mark != std::string::npos);
        const std::string xml = one.xml.substr(0, mark) + one.xml.substr(mark + 1);
        const Outcome outcome = tryRead(xml);
        INFO("input: " << one.xml.substr(0, 300));
        INFO("outcome: " << outcome.text());
        CHECK(outcome.scene.has_value() == !one.refused);
        const Diagnostic* found = outcome.find(one.code);
        if (found == nullptr) {
            FAIL_CHECK("no diagnostic " << one.code);
            continue;
        }
        CHECK(std::to_string(found->where.line) + ":" + std::to_string(found->where.column) ==
              placeOf(xml, mark));
        CHECK((found->severity == Severity::error) == one.refused);
        CHECK_FALSE(found->message.empty());
    }
}

}  // namespace

TEST_CASE("texts that are not well-formed are repaired with a warning") {
    check({
        {transform("<rotate angle=^-90 x=\"1\"/>"), false, "xml.unquoted"},
        {transform("<translate x=^1/>"), false, "xml.unquoted"},
        {"<world> ^<>\n<group/></world>", false, "xml.stray-text"},
        {"<world>\n  <group/>^>\n</world>", false, "xml.stray-text"},
        {"<world>^hello<group/></world>", false, "xml.stray-text"},
        {"^junk <world/>", false, "xml.stray-text"},
        {"<world/>^junk", false, "xml.stray-text"},
        {"<world><!-- a ^-- b --></world>", false, "xml.comment-dashes"},
        {transform("<translate x=\"1\"^y=\"2\"/>"), false, "xml.blank"},
        {"^< world></world>", false, "xml.blank"},
        {"<world><group ^/ ></world>", false, "xml.blank"},
        {transform("<translate x=\"1\" ^x=\"2\"/>"), false, "xml.duplicate-attribute"},
        {transform("<translate x=\"1\" ^X=\"2\"/>"), false, "xml.duplicate-attribute"},
        {"<world><group ^name/></world>", false, "xml.no-value"},
        {"<world><group ^,/></world>", false, "xml.stray-text"},
        {"<world><Group>^</group></world>", false, "xml.case"},
        {"<world><title>a ^& b</title></world>", false, "xml.ampersand"},
        {"<world><group name=^“x”/></world>", false, "xml.quote-style"},
        {"^<world><title>caf\xE9</title></world>", false, "xml.encoding"},
        {"<world><group name=\"a^\x01\"/></world>", false, "xml.character"},
        {"^<?xml version=\"1.0\"><world/>", false, "xml.instruction"},
        {"<world>^<![CDATA[x]]></world>", false, "xml.stray-text"},
        {"\xEF\xBB\xBF<world>^x</world>", false, "xml.stray-text"},
        {"<world>\r\n\r\n  ^x</world>", false, "xml.stray-text"},
        {"<world>\r\r  ^x</world>", false, "xml.stray-text"},
        {"<world><group></group^ x></world>", false, "xml.stray-text"},
    });
}

TEST_CASE("UTF-16 is read, and its findings have the columns of UTF-8") {
    const std::u16string text =
        u"\uFEFF<?xml version=\"1.0\" encoding=\"utf-16\"?>\r\n"
        u"<world><title>\u00e9</title> x<group/></world>";
    std::string bytes;
    for (const char16_t unit : text)
        (bytes += static_cast<char>(unit & 0xFFU)) += static_cast<char>(unit >> 8U);
    const Outcome outcome = tryRead(bytes);
    INFO(outcome.text());
    REQUIRE(outcome.scene);
    CHECK(outcome.scene->title == "\xC3\xA9");
    CHECK(outcome.find("xml.encoding") == nullptr);
    const Diagnostic* stray = outcome.find("xml.stray-text");
    REQUIRE(stray != nullptr);
    CHECK(stray->where.line == 2);
    CHECK(stray->where.column == 26);
    ReadOptions small;
    small.limits.bytes = static_cast<int>(bytes.size()) - 1;
    CHECK(tryRead(bytes, small).find("limit.bytes") != nullptr);
}

TEST_CASE("texts that cannot be repaired are refused with line and column") {
    check({
        {"^", true, "xml.empty"},
        {"^ \n\t ", true, "xml.empty"},
        {"\xEF\xBB\xBF^", true, "xml.empty"},
        {"^<!-- nothing -->", true, "xml.no-root"},
        {"^hello", true, "xml.no-root"},
        {"^{\"a\": 1}", true, "xml.no-root"},
        {std::string("<world>\n a^\0b</world>", 21), true, "xml.character"},
        {std::string("^\xFD"
                     "7zXZ\0\0\4",
                     9),
         true, "xml.character"},
        {"<world>\n ^<group>\n</world>", true, "xml.unclosed"},
        {"<world>\n <group>\n  ^<models>", true, "xml.unclosed"},
        {"<world>\n <group>^</grup>\n</world>", true, "xml.mismatch"},
        {"<world>^</group></world>", true, "xml.mismatch"},
        {"<world>^<group <models/></group></world>", true, "xml.tag"},
        {"<world>^<group", true, "xml.tag"},
        {"<world>^</world", true, "xml.tag"},
        {"<world><group name=^\"x></group></world>", true, "xml.quote"},
        {"<world>\n^<!-- never closed </world>", true, "xml.comment"},
        {"^<!DOCTYPE w [<!ENTITY a \"aa\">]>\n<world>&a;</world>", true, "xml.doctype"},
        {"<world><group name=\"^&bomb;\"/></world>", true, "xml.entity"},
        {"<world><group name=\"^&#0;\"/></world>", true, "xml.entity"},
        {"<world><group name=\"^&#xD800;\"/></world>", true, "xml.entity"},
        {"<world><title>^<![CDATA[x</title></world>", true, "xml.unclosed"},
    });
}

TEST_CASE("documents that are not scenes are refused") {
    check({
        {"^<html></html>", true, "scene.root"},
        {"^<word></word>", true, "scene.root"},
        {"\n^<wrold/>", true, "scene.root"},
        {"^<Scene><Cameras/><Objects/></Scene>", true, "scene.foreign"},
        {transform("<translate ^w=\"4\"/>"), true, "scene.unknown-attribute"},
        {transform("<translate x=\"^abc\"/>"), true, "scene.number"},
        {transform("<translate x=\"^NaN\"/>"), true, "scene.number"},
        {transform("<translate x=\"^inf\"/>"), true, "scene.number"},
        {transform("<translate x=\"^-Infinity\"/>"), true, "scene.number"},
        {transform("<translate x=\"^1e999\"/>"), true, "scene.number"},
        {transform("<translate x=\"^1e19\"/>"), true, "scene.number"},
        {transform("<translate x=\"^0x10\"/>"), true, "scene.number"},
        {transform("<translate x=\"^--1\"/>"), true, "scene.number"},
        {transform("<translate x=\"^+-1\"/>"), true, "scene.number"},
        {"<world><window width=\"^0\"/></world>", true, "scene.range"},
        {"<world><window height=\"^100000\"/></world>", true, "scene.range"},
        {camera("<projection fov=\"^0\"/>"), true, "scene.range"},
        {camera("<projection fov=\"^180\"/>"), true, "scene.range"},
        {camera("<projection fov=\"^-60\"/>"), true, "scene.range"},
        {camera("<projection near=\"^0\"/>"), true, "scene.range"},
        {camera("<projection near=\"^-1\"/>"), true, "scene.range"},
        {world("<camera>^<projection near=\"5\" far=\"5\"/></camera>"), true, "scene.camera"},
        {world("<camera>^<projection near=\"5\" far=\"2\"/></camera>"), true, "scene.camera"},
        {world("^<camera><position x=\"1\"/><lookAt x=\"1\"/></camera>"), true, "scene.camera"},
        {world("^<camera><position x=\"0\"/></camera>"), true, "scene.camera"},
        {camera("<position x=\"3\"/>^<up y=\"0\"/>"), true, "scene.zero-direction"},
        {world("<lights>^<light type=\"directional\"/></lights>"), true, "scene.zero-direction"},
        {world("<lights>^<light type=\"directional\" dirX=\"0\"/></lights>"), true,
         "scene.zero-direction"},
        {world("<lights>^<light type=\"spot\" posX=\"1\"/></lights>"), true,
         "scene.zero-direction"},
        {light("type=\"spot\" dirX=\"1\" cutoff=\"^181\""), true, "scene.range"},
        {light("type=\"spot\" dirX=\"1\" cutoff=\"^-1\""), true, "scene.range"},
        {light("type=\"spot\" dirX=\"1\" exponent=\"^-1\""), true, "scene.range"},
        {light("type=\"^laser\""), true, "scene.value"},
        {world("<lights>^<light type=\"point\" constant=\"0\"/></lights>"), true,
         "scene.attenuation"},
        {light("type=\"point\" linear=\"^-1\""), true, "scene.range"},
        {transform("<translate time=\"^-1\"><point/></translate>"), true, "scene.range"},
        {transform("^<translate time=\"10\"/>"), true, "scene.points"},
        {transform("<translate align=\"^maybe\"/>"), true, "scene.value"},
        {group("<models>^<model/></models>"), true, "scene.missing-attribute"},
        {group("<models>^<model file=\"\"/></models>"), true, "scene.missing-attribute"},
        {model("<color><shininess value=\"^-1\"/></color>"), true, "scene.range"},
        {group("<models><model file=\"p.ply\" revolve=\"^2\"/></models>"), true, "scene.range"},
        {model("<texture file=\"^chess:0x8\"/>"), true, "scene.value"},
        {model("<texture file=\"^chess:8\"/>"), true, "scene.value"},
        {model("<texture file=\"a.jpg\"/><texgen s=\"^1 0 0\"/>"), true, "scene.number"},
        {world("<render aa=\"^3\"/>"), true, "scene.range"},
        {world("<render shading=\"^nice\"/>"), true, "scene.value"},
        {world("<render time=\"^5..1\"/>"), true, "scene.value"},
        {world("<xmls>^<xml/></xmls>"), true, "scene.missing-attribute"},
        {world("<xmls><xml file=\"^no.xml\"/></xmls>"), true, "asset.missing"},
        {world("<entity file=\"^no.xml\"/>"), true, "asset.missing"},
        {world("<skybox texture=\"a.jpg\" width=\"^0\"/>"), true, "scene.range"},
        {world("<background color=\"^nice\"/>"), true, "scene.unknown-color"},
    });
}

TEST_CASE("oddities of scenes are reported") {
    check({
        {transform("<translate x=\"1\" ^w=\"4\"/>"), false, "scene.unknown-attribute"},
        {transform("<translate x=\"^1,5\"/>"), false, "scene.number"},
        {transform("<translate x=\"^1.2.3\"/>"), false, "scene.number"},
        {transform("<translate x=\"^1 2\"/>"), false, "scene.number"},
        {transform("<translate x=\"^1px\"/>"), false, "scene.number"},
        {"<world><window width=\"^10.5\"/></world>", false, "scene.number"},
        {transform("^<rotate angle=\"90\"/>"), false, "scene.zero-direction"},
        {transform("^<rotate time=\"5\" x=\"0\"/>"), false, "scene.zero-direction"},
        {scene2017("^<rotate angle=5/>"), false, "scene.zero-direction"},
        {transform("<rotate time=\"^0\" x=\"1\"/>"), false, "scene.range"},
        {transform("<translate time=\"^0\"><point/></translate>"), false, "scene.range"},
        {"<world/>\n^<world/>", false, "xml.extra-root"},
        {"<world>\n^<<<<<<< HEAD\n<group/>\n=======\n<group\n>>>>>>> b\n</world>", false,
         "xml.conflict"},
        {"^<!DOCTYPE world><world/>", false, "xml.doctype"},
        {"^<group><model file=\"a\"/></group>", false, "scene.root"},
        {model("^<color R=\"255\"/>"), false, "scene.misplaced"},
        {group("^<color/>"), false, "scene.missing-attribute"},
        {transform("<translate ^x=\"\"/>"), false, "scene.empty-value"},
        {transform("<translate x=\"1\"/>^<translate x=\"2\"/>"), false,
         "scene.duplicate-transform"},
        {group("<models/>^<models/>"), false, "scene.duplicate-models"},
        {group("<models/><transform>^<scale x=\"2\"/></transform>"), false, "scene.order"},
        {transform("^<rotate x=\"1\"/>"), false, "scene.missing-attribute"},
        {transform("<rotate x=\"1\" angle=\"^3\" time=\"4\"/>"), false, "scene.ineffective"},
        {transform("<translate x=\"1\" align=\"^true\"/>"), false, "scene.ineffective"},
        {transform("^<translate time=\"9\"><point x=\"1\"/></translate>"), false, "scene.points"},
        {transform("^<translate><point/><point/><point/><point/></translate>"), false,
         "scene.missing-attribute"},
        {world("^<grop/>"), false, "scene.unknown-element"},
        {world("^<point/>"), false, "scene.misplaced"},
        {world("^<camera/>"), false, "scene.missing-element"},
        {world("<window/>^<window/>"), false, "scene.duplicate-element"},
        {"<world camX=\"1\">^<camera><position x=\"1\"/></camera></world>", false,
         "scene.duplicate-element"},
        {camera("<position x=\"1\"/>^<pos x=\"2\"/>"), false, "scene.duplicate-element"},
        {world("<render aa=\"4\"/>^<render aa=\"1\"/>"), false, "scene.duplicate-element"},
        {world("<lights/>^<lights/>"), false, "scene.duplicate-element"},
        {model("<color><diffuse R=\"9\"/>^<diffuse R=\"8\"/></color>"), false,
         "scene.duplicate-element"},
        {model("<color/>^<color/>"), false, "scene.duplicate-element"},
        // Content of an element that holds nothing would be lost without a message.
        {world("<lights><light type=\"point\">^<diffuse R=\"9\"/></light></lights>"), false,
         "scene.misplaced"},
        {transform("<rotate angle=\"9\" y=\"1\">^<axis/></rotate>"), false,
         "scene.unknown-element"},
        {model("<texture file=\"a.png\">^<texgen/></texture>"), false, "scene.misplaced"},
        {group("<scatter count=\"3\" xzMin=\"^5\" xzMax=\"2\"/>"), false, "scene.swapped"},
        {group("<models><model file=\"a\" rand=\"3\" yMinR=\"^5\" yMaxR=\"2\"/></models>"), false,
         "scene.swapped"},
        {"^<world/>", false, "scene.empty"},
        {"^<world><group><models/></group></world>", false, "scene.empty"},
        {world("<lights>^<light posX=\"1\"/></lights>"), false, "scene.missing-attribute"},
        {world("<lights>^<light type=\"directional\" posX=\"1\"/></lights>"), false,
         "scene.missing-attribute"},
        {model("<color><diffuse R=\"^300\" G=\"0\" B=\"0\"/></color>"), false, "scene.clamped"},
        {model("<color>^<diffuse R=\"0.5\" G=\"0\" B=\"0\"/></color>"), false, "scene.color-scale"},
        {model("<color>^<diffuse R=\"1\" G=\"0\" B=\"1\"/></color>"), false, "scene.color-scale"},
        {model("^<texture/>"), false, "scene.missing-attribute"},
        {model("^<texgen s=\"1 0 0 0\"/>"), false, "scene.ineffective"},
        {model("^<generator/>"), false, "scene.missing-attribute"},
        {"<world><!-- generator box 1 a.3d -->^<!-- generator box 2 a.3d --></world>", false,
         "scene.generator-conflict"},
        {world("^<skybox/>"), false, "scene.missing-attribute"},
        {world("^<background/>"), false, "scene.missing-attribute"},
    });
}

TEST_CASE("the older dialects refuse what they forbid") {
    check({
        {scene2017("<translate ^w=4/>"), true, "scene.unknown-attribute"},
        {scene2017("<scale ^factor=4/>"), true, "scene.unknown-attribute"},
        {scene2017("<translate x=1/>\n^<translate x=2/>"), true, "scene.duplicate-transform"},
        {scene2017("<models/>\n ^<models/>"), true, "scene.duplicate-models"},
        {scene2017("<group><models/>\n^<translate x=1/></group>"), true, "scene.order"},
        {scene2017("<group><group/>\n^<rotate angle=1 axisX=1/></group>"), true, "scene.order"},
        {scene2017("<translate x=1/><models><model file=a diffR=^128 diffG=0/></models>"), false,
         "scene.color-scale"},
        {scene2020("<models><model command=\"plane 4\" diffuse=\"^nocolor\"/></models>"), true,
         "scene.unknown-color"},
        {"<scene><colors>^<color r=\"1\"/></colors></scene>", false, "scene.missing-attribute"},
        {"<scene><colors><color name=\"^rgb\" r=\"1\"/></colors></scene>", false, "scene.value"},
        {"<scene>^<transform/><translate x=\"1\"/></scene>", false, "scene.dialect"},
    });
}

TEST_CASE("the ninth light of the 2020 dialect is refused, and of no other") {
    std::string lights = "<lights>\n";
    for (int i = 0; i < 9; ++i) lights += "<light type=\"POINT\" posX=\"1\"/>\n";
    lights += "</lights>";
    const Outcome refused = tryRead(scene2020(lights));
    REQUIRE_FALSE(refused.scene);
    CHECK(refused.diagnostics.front().code == "limit.lights");
    CHECK(refused.diagnostics.front().where.line == 10);
    CHECK(tryRead(world(lights)).scene->lights.size() == 9);
    CHECK(tryRead(scene2017(lights)).scene->lights.size() == 9);
}

TEST_CASE("warnings are errors when strict") {
    ReadOptions strict;
    strict.strict = true;
    for (const std::string& xml :
         {transform("<translate x=\"1\" w=\"4\"/>"), transform("<translate x=1/>"),
          world("<grop/>"), std::string("<world>junk</world>")}) {
        INFO(xml);
        CHECK(tryRead(xml).scene);
        const Outcome outcome = tryRead(xml, strict);
        CHECK_FALSE(outcome.scene);
        REQUIRE_FALSE(outcome.diagnostics.empty());
        CHECK(outcome.diagnostics.front().severity == Severity::error);
    }
    CHECK(tryRead(model("<texture file=\"t.png\"/>"), strict).scene);
    CHECK(
        tryRead("<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?><!-- \xE9 -->" + model(""), strict)
            .scene);
    CHECK_FALSE(
        tryRead("<?xml version=\"1.0\" encoding=\"utf-8\"?><!-- \xE9 -->" + model(""), strict)
            .scene);
}

TEST_CASE("unknown names are reported with the nearest known one") {
    const auto message = [](const std::string& xml, const std::string& code) {
        const Outcome outcome = tryRead(xml);
        const Diagnostic* found = outcome.find(code);
        return found != nullptr ? found->message : std::string("none");
    };
    CHECK_THAT(message(world("<grop/>"), "scene.unknown-element"), Catch::Contains("<group>"));
    CHECK_THAT(message(camera("<projection fvo=\"1\"/>"), "scene.unknown-attribute"),
               Catch::Contains("\"fov\""));
    CHECK_THAT(message(light("type=\"pont\""), "scene.value"), Catch::Contains("\"point\""));
    CHECK_THAT(message("<wrold/>", "scene.root"), Catch::Contains("<world>"));
    CHECK_THAT(message(world("<point/>"), "scene.misplaced"), Catch::Contains("<translate>"));
    CHECK_THAT(message(world("<group><models><color/></models></group>"), "scene.misplaced"),
               Catch::Contains("in <model>"));
    CHECK_THAT(message(world("<camera><lights/></camera>"), "scene.misplaced"),
               Catch::Contains("in <world>"));
    CHECK_THAT(message(world("<group><camera><lights/></camera></group>"), "scene.misplaced"),
               Catch::Contains("in <world>"));
    CHECK_THAT(
        message(world("<group><models><file=\"a.3d\"/></models></group>"), "scene.unknown-element"),
        Catch::Contains("<model file=\"...\">"));
    CHECK_THAT(message("<world/><group/>", "xml.extra-root"), Catch::Contains("before </world>"));
    CHECK_THAT(message("<group/><world/>", "xml.extra-root"), !Catch::Contains("before"));
    CHECK_THAT(message("<world><group name=\"a></group></world>", "xml.quote"),
               Catch::Contains("\"name\"") && Catch::Contains("write \" at"));
    CHECK_THAT(message("<world><group><models><model><color><diffuse R=\"1\"/>", "xml.unclosed"),
               Catch::Contains("cut off") && Catch::Contains("write </color>"));
    CHECK_THAT(message("<world><group/>", "xml.unclosed"), !Catch::Contains("cut off"));
    CHECK_THAT(message(transform("<translate x=\"1,5\"/>"), "scene.number"),
               Catch::Contains("1.5"));
    CHECK_THAT(message(transform("<translate x=\"1 y=\"2\"/>"), "scene.number"),
               Catch::Contains("closing quote"));
    CHECK_THAT(message(scene2020("<models><model command=\"box 1\" diffuse=\"C\"/></models>"),
                       "scene.unknown-color"),
               Catch::Contains("\"c\""));
    CHECK_THAT(
        message(scene2017("<models><model file=\"a\" rand=\"-1\"/></models>"), "scene.range"),
        Catch::EndsWith("0 to 100000"));
    // Words of other languages.
    const auto model = [](const std::string& attributes, const std::string& children) {
        return world("<group><models><model command=\"box 1\" " + attributes + ">" + children +
                     "</model></models></group>");
    };
    for (const char* word : {"alpha", "transparency", "transparent"}) {
        CAPTURE(word);
        const std::string name(word);
        CHECK_THAT(message(model(name + "=\"0.5\"", ""), "scene.unknown-attribute"),
                   Catch::EndsWith("did you mean \"opacity\"?"));
        CHECK_THAT(message(model("", "<" + name + "/>"), "scene.unknown-element"),
                   Catch::EndsWith("did you mean <model opacity=\"...\">?"));
        CHECK_THAT(message(model("", "<color><" + name + "/></color>"), "scene.unknown-element"),
                   Catch::EndsWith("did you mean <diffuse A=\"...\">?"));
    }
    for (const std::string& xml :
         {world("<group><shadows/></group>"), model("", "<shadow/>"),
          world("<lights><castShadows on=\"true\"/></lights>"), camera("<shadows/>")})
        CHECK_THAT(message(xml, "scene.unknown-element"),
                   Catch::EndsWith("did you mean <render shadows=\"map\">?"));
    CHECK_THAT(message(world("<group/><shadows/>"), "scene.unknown-element"),
               Catch::EndsWith("did you mean <render shadows=\"...\">?"));
    CHECK_THAT(message(light("type=\"point\" castShadows=\"true\""), "scene.unknown-attribute"),
               Catch::EndsWith("write <render shadows=\"map\"/> in the root element"));
    // A letter is near every other letter: that is no help.
    CHECK_THAT(message(light("type=\"point\" R=\"1\""), "scene.unknown-attribute"),
               !Catch::Contains("did you mean"));
}

TEST_CASE("a refused document tells all that was found") {
    const Outcome outcome = tryRead(
        "<world>\n<grop/>\n<group><transform><translate x=\"a\"/>\n<rotate angle=\"b\"/>\n"
        "</transform>\n<models></group></world>");
    REQUIRE_FALSE(outcome.scene);
    std::vector<int> lines;
    for (const Diagnostic& one : outcome.diagnostics) lines.push_back(one.where.line);
    CHECK(lines == std::vector<int>{6, 2, 3, 4});  // errors of the document come first
    CHECK(outcome.find("xml.unclosed") != nullptr);
}

TEST_CASE("a truncated document is reported as such, whatever it seems to say") {
    const std::string whole =
        "<world>\n<camera><position x=\"0\" y=\"0\" z=\"0\"/><lookAt x=\"1\"/></camera>\n"
        "<lights><light type=\"directional\" dirX=\"1\"/></lights>\n"
        "<group><transform><rotate angle=\"9\" y=\"1\"/></transform></group>\n</world>";
    for (std::size_t length = 1; length < whole.size(); ++length) {
        const Outcome outcome = tryRead(whole.substr(0, length));
        INFO(whole.substr(0, length));
        INFO(outcome.text());
        REQUIRE_FALSE(outcome.scene);
        CHECK(outcome.diagnostics.front().code.rfind("xml.", 0) == 0);
    }
    CHECK(tryRead(whole).scene);
}
