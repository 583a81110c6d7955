// The mistakes that students make, each in the same scene: the messages word for word, their
// places, and whether there is an image all the same.
#include <catch2/catch.hpp>

#include "tests/unit/scene/reading.h"

using namespace farol;
using namespace farol::scene;
using namespace farol::scene::test;

namespace {

const std::string kScene = R"(<world>
    <window width="300" height="200" />
    <camera>
        <position x="3" y="2" z="1" />
        <lookAt x="0" y="0" z="0" />
        <up x="0" y="1" z="0" />
        <projection fov="60" near="1" far="1000" />
    </camera>
    <lights>
        <light type="point" posX="0" posY="10" posZ="0" />
    </lights>
    <group>
        <transform>
            <translate x="0" y="1" z="0" />
            <rotate angle="45" x="0" y="1" z="0" />
        </transform>
        <models>
            <model file="sphere_1_10_10.3d">
                <color>
                    <diffuse R="200" G="200" B="0" />
                    <specular R="255" G="255" B="255" />
                    <shininess value="50" />
                </color>
            </model>
        </models>
    </group>
</world>
)";

/// The scene with some of its lines replaced.
struct Mistake {
    const char* name;
    int line, lines;  ///< the first line, from 1; how many are replaced
    std::string text;
    bool refused;
    std::string said;  ///< a line each: code, line:column, message
};

std::string mistaken(const Mistake& one) {
    std::size_t begin = 0;
    for (int i = 1; i < one.line; ++i) begin = kScene.find('\n', begin) + 1;
    std::size_t end = begin;
    for (int i = 0; i < one.lines; ++i) end = kScene.find('\n', end) + 1;
    return kScene.substr(0, begin) + one.text + kScene.substr(end);
}

const std::vector<Mistake>& mistakes() {
    static const std::vector<Mistake> all = {
        {"unclosed group", 26, 1, R"()", true,
         R"(xml.unclosed 12:5 <group> is not closed before </world> in line 26; write </group>
)"},
        {"unclosed camera", 8, 1, R"()", true,
         R"(xml.unclosed 3:5 <camera> is not closed before </world> in line 26; write </camera>
)"},
        {"crossed", 16, 2,
         R"(        <models>
        </transform>
)",
         true,
         R"(xml.unclosed 16:9 <models> is not closed before </transform> in line 17; write </models>
xml.mismatch 25:9 </models> closes an element that is not open
)"},
        {"typo model", 18, 7,
         R"(            <modle file="sphere_1_10_10.3d">
                <color>
                    <diffuse R="200" G="200" B="0" />
                    <specular R="255" G="255" B="255" />
                    <shininess value="50" />
                </color>
            </modle>
)",
         false,
         R"(scene.empty 1:1 no <model> to draw, so the image is black; expected a <model> in the <models> of a <group>
scene.unknown-element 18:13 unknown element <modle> in <models> is ignored; did you mean <model>?
)"},
        {"typo translate", 14, 1,
         R"(            <tranlate x="0" y="1" z="0" />
)",
         false,
         R"(scene.unknown-element 14:13 unknown element <tranlate> in <transform> is ignored; did you mean <translate>?
)"},
        {"typo attr", 15, 1,
         R"(            <rotate angel="45" x="0" y="1" z="0" />
)",
         false,
         R"(scene.missing-attribute 15:13 <rotate> has neither "angle" nor "time" and turns nothing
scene.unknown-attribute 15:21 <rotate> has no attribute "angel"; did you mean "angle"?
)"},
        {"comma", 4, 1,
         R"(        <position x="3" y="2,5" z="1" />
)",
         false,
         R"(scene.number 4:28 "y" of <position> is "2,5", which is not a number; using 2.5
)"},
        {"zero axis", 15, 1,
         R"(            <rotate angle="45" x="0" y="0" z="0" />
)",
         false,
         R"(scene.zero-direction 15:13 axis of <rotate> is 0 0 0, so it turns nothing; give at least one of x, y and z
)"},
        {"up parallel", 4, 1,
         R"(        <position x="0" y="5" z="0" />
)",
         false,
         R"(scene.camera 6:9 <up> of the camera is parallel to its view; using the axis farthest from it
)"},
        {"near far", 7, 1,
         R"(        <projection fov="60" near="1000" far="1" />
)",
         true,
         R"(scene.camera 7:9 "far" 1 of the camera is not more than "near" 1000; give a larger far
)"},
        {"color01", 20, 1,
         R"(                    <diffuse R="0.8" G="0.8" B="0" />
)",
         false,
         R"(scene.color-scale 20:21 <diffuse> is nearly black as 0 to 255; reading it as 0 to 1
)"},
        {"color01 int", 20, 1,
         R"(                    <diffuse R="1" G="1" B="0" />
)",
         false,
         R"(scene.color-scale 20:21 <diffuse> is nearly black as 0 to 255; did you mean 0 to 1 (max="1")?
)"},
        {"color over", 20, 1,
         R"(                    <diffuse R="300" G="200" B="0" />
)",
         false,
         R"(scene.clamped 20:33 "R" of <diffuse> is "300"; expected 0 to 255, using 255
)"},
        {"two cameras", 9, 0,
         R"(    <camera>
        <position x="9" y="9" z="9" />
    </camera>
)",
         false,
         R"(scene.duplicate-element 9:5 second <camera> in one <world>; using it instead of the first
scene.missing-element 9:5 no <lookAt> in <camera>; looking at 0 0 0
)"},
        {"dir light none", 10, 1,
         R"(        <light type="directional" />
)",
         true,
         R"(scene.zero-direction 10:9 direction of the directional <light> is 0 0 0; give at least one of dirX, dirY and dirZ
)"},
        {"two transforms", 17, 0,
         R"(        <transform>
            <scale x="2" y="2" z="2" />
        </transform>
)",
         false,
         R"(scene.duplicate-transform 17:9 second <transform> in one group; both apply, in this order
)"},
        {"two translates", 15, 0,
         R"(            <translate x="1" y="0" z="0" />
)",
         false,
         R"(scene.duplicate-transform 15:13 second <translate> in one group; both apply, in this order
)"},
        {"time no points", 14, 1,
         R"(            <translate time="10" align="true" />
)",
         true,
         R"(scene.points 14:13 <translate> with a time has no points; expected at least 4
)"},
        {"three points", 14, 1,
         R"(            <translate time="10" align="true">
<point x="0" y="0" z="0"/>
<point x="1" y="0" z="0"/>
<point x="1" y="1" z="0"/>
</translate>
)",
         false,
         R"(scene.points 14:13 curve of 3 points; expected at least 4
)"},
        {"missing slash", 5, 1,
         R"(        <lookAt x="0" y="0" z="0" >
)",
         true,
         R"(xml.unclosed 5:9 <lookAt> is not closed before </camera> in line 8; end its tag with "/>"
)"},
        {"missing quote", 14, 1,
         R"(            <translate x="0 y="1" z="0" />
)",
         true,
         R"(scene.number 14:27 "x" of <translate> is "0 y=", which is not a number; is its closing quote missing?
xml.stray-text 14:32 stray text "1"" in the tag <translate> is ignored
)"},
        {"missing gt", 6, 1,
         R"(        <up x="0" y="1" z="0" /
)",
         false,
         R"(xml.tag 6:9 the tag <up> ends with "/" alone; write "/>"
)"},
        {"transform after", 26, 0,
         R"(        <transform>
            <scale x="2" y="2" z="2" />
        </transform>
)",
         false,
         R"(scene.duplicate-transform 26:9 second <transform> in one group; both apply, in this order
scene.order 27:13 <scale> after the group's models or groups; it applies to the whole group
)"},
        {"text number", 7, 1,
         R"(        <projection fov="60deg" near="1" far="1000" />
)",
         false,
         R"(scene.number 7:26 "fov" of <projection> is "60deg", which is not a number; using 60
)"},
        {"fov200", 7, 1,
         R"(        <projection fov="200" near="1" far="1000" />
)",
         true,
         R"(scene.range 7:26 "fov" of <projection> is "200"; expected 0.001 to 179.999
)"},
        {"cutoff", 10, 1,
         R"(        <light type="spot" posX="0" posY="10" posZ="0" dirX="0" dirY="-1" dirZ="0" cutoff="270" />
)",
         true,
         R"(scene.range 10:92 "cutoff" of <light> is "270"; expected 0 to 180
)"},
        {"spot nodir", 10, 1,
         R"(        <light type="spotlight" posX="0" posY="10" posZ="0" cutoff="45" />
)",
         true,
         R"(scene.zero-direction 10:9 direction of the spot <light> is 0 0 0; give at least one of dirX, dirY and dirZ
)"},
        {"light type", 10, 1,
         R"(        <light type="pointlight" posX="0" posY="10" posZ="0" />
)",
         true,
         R"(scene.value 10:22 "type" of <light> is "pointlight"; expected one of point, directional, spot
)"},
        {"eye center", 4, 1,
         R"(        <position x="0" y="0" z="0" />
)",
         true,
         R"(scene.camera 3:5 <position> and <lookAt> of the camera are the same point; move one of them
)"},
        {"up zero", 6, 1,
         R"(        <up x="0" y="0" z="0" />
)",
         true,
         R"(scene.zero-direction 6:9 <up> of the camera is 0 0 0; give at least one of x, y and z
)"},
        {"near0", 7, 1,
         R"(        <projection fov="60" near="0" far="1000" />
)",
         true,
         R"(scene.range 7:36 "near" of <projection> is "0"; expected more than 0
)"},
        {"near neg", 7, 1,
         R"(        <projection fov="60" near="-1" far="1000" />
)",
         true,
         R"(scene.range 7:36 "near" of <projection> is "-1"; expected more than 0
)"},
        {"scale oneattr", 15, 1,
         R"(            <scale value="2" />
)",
         true,
         R"(scene.unknown-attribute 15:20 <scale> has no attribute "value"; it has x, y, z
)"},
        {"model nofile", 18, 1,
         R"(            <model>
)",
         true,
         R"(scene.missing-attribute 18:13 <model> has neither "file" nor "command"; add one
)"},
        {"model name", 18, 1,
         R"(            <model name="sphere_1_10_10.3d">
)",
         true,
         R"(scene.missing-attribute 18:13 <model> has neither "file" nor "command"; add one
)"},
        {"shininess attr", 22, 1,
         R"(                    <shininess>50</shininess>
)",
         false,
         R"(xml.stray-text 22:32 stray text "50" is ignored; write values as attributes: name="50"
)"},
        {"rotate noangle", 15, 1,
         R"(            <rotate x="0" y="1" z="0" />
)",
         false,
         R"(scene.missing-attribute 15:13 <rotate> has neither "angle" nor "time" and turns nothing
)"},
        {"rotate time0", 15, 1,
         R"(            <rotate time="0" x="0" y="1" z="0" />
)",
         false,
         R"(scene.range 15:27 "time" of <rotate> is 0, so it turns nothing; expected the seconds of one turn
)"},
        {"hash comment", 3, 0,
         R"(    # camera
    // of the scene
)",
         false,
         R"(xml.stray-text 3:5 stray text "# camera     // of the scene" is ignored
)"},
        {"comment unclosed", 3, 0,
         R"(    <!-- camera
)",
         true,
         R"(xml.comment 3:5 the comment is not closed; write "-->" at its end
)"},
        {"neg window", 2, 1,
         R"(    <window width="-300" height="200" />
)",
         true,
         R"(scene.range 2:20 "width" of <window> is "-300"; expected 1 to 4096
)"},
        {"float window", 2, 1,
         R"(    <window width="300.5" height="200" />
)",
         false,
         R"(scene.number 2:20 "width" of <window> is "300.5", which is not a whole number; using 300
)"},
        {"amp", 2, 0,
         R"(    <title>A & B</title>
)",
         false,
         R"(xml.ampersand 2:14 "&" alone is read as the character; write "&amp;"
)"},
        {"doctype", 1, 0,
         R"(<!DOCTYPE world>
)",
         false,
         R"(xml.doctype 1:1 the document type is ignored, and its file is not opened
)"},
        {"self close group", 12, 1,
         R"(    <group/>
)",
         true,
         R"(xml.mismatch 26:5 </group> closes an element that is not open; <group> in line 12 is closed by its "/>" already
)"},
        {"points text", 14, 1,
         R"(            <translate time="10">
<p x="0" y="0" z="0"/>
<p x="1" y="0" z="0"/>
</translate>
)",
         true,
         R"(scene.points 14:13 <translate> with a time has no points; expected at least 4
scene.unknown-element 15:1 unknown element <p> in <translate> is ignored
scene.unknown-element 16:1 unknown element <p> in <translate> is ignored
)"},
        {"color hex", 20, 1,
         R"(                    <diffuse value="#ff0000" />
)",
         false,
         R"(scene.unknown-attribute 20:30 <diffuse> has no attribute "value"; write the colour as R="255" G="0" B="0"
)"},
        {"capital close", 25, 1,
         R"(        </Models>
)",
         false,
         R"(xml.case 25:9 <models> is closed by </Models>; write both alike
)"},
        {"nan", 4, 1,
         R"(        <position x="3" y="nan" z="1" />
)",
         true,
         R"(scene.number 4:28 "y" of <position> is "nan", which is not a finite number
)"},
        {"blank attr", 4, 1,
         R"(        <position x="3" y="" z="1" />
)",
         false,
         R"(scene.empty-value 4:25 "y" of <position> is empty; using its default
)"},
        {"fov in radians", 7, 1,
         R"(        <projection fov="1.0472" near="1" far="1000" />
)",
         false,
         R"(scene.radians 7:26 "fov" of <projection> is "1.0472", which looks like radians; expected degrees (did you mean 60?)
)"},
        {"angle in radians", 15, 1,
         R"(            <rotate angle="-1.57" x="0" y="1" z="0" />
)",
         false,
         R"(scene.radians 15:28 "angle" of <rotate> is "-1.57", which looks like radians; expected degrees (did you mean -90?)
)"},
        {"cutoff in radians", 10, 1,
         R"(        <light type="spot" posX="0" posY="10" posZ="0" dirX="0" dirY="-1" dirZ="0" cutoff="0.5236" />
)",
         false,
         R"(scene.radians 10:92 "cutoff" of <light> is "0.5236", which looks like radians; expected degrees (did you mean 30?)
)"},
        {"small angles in degrees", 15, 1,
         R"(            <rotate angle="1.5" x="0" y="1" z="0" />
)",
         false, ""},
        {"no lookAt", 5, 1, "", false,
         R"(scene.missing-element 3:5 no <lookAt> in <camera>; looking at 0 0 0
)"},
        {"no size", 15, 1,
         R"(            <scale x="0" y="0" z="0" />
)",
         false,
         R"(scene.invisible 15:13 <scale> is 0 along two axes or three, so nothing of its group is visible; write 1 to keep a size
)"},
        {"flattened to a shadow", 15, 1,
         R"(            <scale x="1" y="0" z="1" />
)",
         false, ""},
    };
    return all;
}

}  // namespace

TEST_CASE("messages about students' mistakes") {
    for (const Mistake& one : mistakes()) {
        CAPTURE(one.name);
        CHECK(tryRead(mistaken(one)).text() == (one.refused ? "refused\n" : "read\n") + one.said);
    }
}

TEST_CASE("a mistake is reported alike with a byte order mark and Windows line ends") {
    for (const Mistake& one : mistakes()) {
        CAPTURE(one.name);
        std::string windows = "\xEF\xBB\xBF";
        for (const char c : mistaken(one)) windows += c == '\n' ? "\r\n" : std::string(1, c);
        const Outcome plain = tryRead(mistaken(one)), other = tryRead(windows);
        REQUIRE(plain.diagnostics.size() == other.diagnostics.size());
        for (std::size_t i = 0; i < plain.diagnostics.size(); ++i) {
            CHECK(plain.diagnostics[i].code == other.diagnostics[i].code);
            CHECK(plain.diagnostics[i].where.line == other.diagnostics[i].where.line);
            CHECK(plain.diagnostics[i].where.column == other.diagnostics[i].where.column);
        }
    }
}

TEST_CASE("the scene without a mistake is read without a word, in capitals too") {
    CHECK(tryRead(kScene).text() == "read\n");
    std::string capitals;
    for (const char c : kScene) capitals += static_cast<char>(std::toupper(c));
    CHECK(tryRead(capitals).text() == "read\n");
}
