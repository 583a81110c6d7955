#include <catch2/catch.hpp>
#include <clocale>
#include <cstdio>
#include <locale>

#include "core/number.h"
#include "scene/write/writer.h"
#include "tests/support/comma_locale.h"
#include "tests/support/scene_equality.h"
#include "tests/unit/scene/reading.h"

using namespace farol;
using namespace farol::scene;
using namespace farol::scene::test;

namespace {

const std::map<std::string, std::string> kFiles = {{"ship.xml", "<scene/>"}};

/// One document that uses everything the language has.
std::string everything() {
    return R"(<world title="x">
  <title>All &amp; everything &lt;here&gt; "quoted"</title><description>Two
lines</description>
  <window width="640" height="480"/>
  <camera><position x="1.1" y="2.2" z="1e-7"/><lookAt x="0.1"/><up x="0.3" y="1"/>
    <projection fov="33.3" near="0.1" far="12345.678"/></camera>
  <render shading="gouraud" aa="8" axes="true" viewer="local" specular="separate"
    transparency="exact" shadows="map" time="1..7.5"/>
  <background texture="b.jpg" color="12,34,56"/><skybox texture="s.jpg" width="123.4"/>
  <entity file="ship.xml"/>
  <colors><color name="warm" r="0.9" g="0.6" b="0.3"/></colors>
  <!-- generator cone 1 2 4 3 c.3d -->
  <lights>
    <light type="point" posX="1" posY="2" posZ="3" constant="0.5" linear="0.1" quadratic="0.01"
           diffuse="warm" ambient="rgb" specR="0.1"/>
    <light type="directional" dirX="0.3" dirY="-1e5"/>
    <light alpha="33" beta="12.5" space="camera"/>
    <light type="spot" posY="4" dirY="-1" cutoff="30" exponent="2.5"/>
  </lights>
  <group name="&lt;outer&gt;">
    <transform>
      <translate x="0.1" y="0.2" z="0.3"/><rotate angle="33" x="1" y="2" z="3"/>
      <scale x="-1" y="0"/>
    </transform>
    <scatter count="9" xzMin="1" xzMax="2" yMin="-1" yMax="1"/>
    <models>
      <model file="c.3d"/>
      <model command="revolution p.ply 32" uv="atlas" lod="auto" twoSided="true" id="i" name="n"
        opacity="0.3"/>
      <model file="p.ply" revolve="12" uv="2017">
        <texture file="t.jpg" filter="nearest"/><texgen mode="eye" s="1 2 3 4" t="0.1 0 0 1"/>
        <color><diffuse R="17" G="99.5" B="254" A="51"/><ambient cycles="true"/>
          <specular R="1" G="2" B="3"/><emissive R="0.1" G="0.2" B="0.3"/>
          <shininess value="77.7"/></color>
      </model>
      <model file="d.3d"><texture file="chess:3x7" color1="1,2,3" color2="#abcdef"
        mapping="sphere"/></model>
    </models>
    <group>
      <transform><translate time="7" align="true"><point x="1"/><point y="1"/><point z="1"/>
        <point x="0.1" y="0.2" z="0.3"/></translate><rotate time="-3" y="1"/></transform>
      <lights><light type="point"/></lights>
    </group>
  </group>
</world>)";
}

void checkRoundTrip(const std::string& xml) {
    const Outcome first = tryRead(xml, {}, kFiles);
    INFO(xml.substr(0, 400));
    INFO(first.text());
    REQUIRE(first.scene);
    const std::string canonical = write(*first.scene);
    const Outcome second = tryRead(canonical, {}, kFiles);
    INFO(canonical);
    INFO(second.text());
    REQUIRE(second.scene);
    CHECK(equal(*first.scene, *second.scene));
    CHECK(write(*second.scene) == canonical);
}

}  // namespace

TEST_CASE("scene to canonical XML to scene is the identity") {
    checkRoundTrip(everything());
    checkRoundTrip("<world/>");
    checkRoundTrip("<scene/>");
    checkRoundTrip(
        scene2017("<translate z=15/><lights><light type=point posY=1/></lights>"
                  "<group><models><model file=a emisR=1 rand=5 xzMaxR=2/></models>"
                  "</group>"));
    checkRoundTrip(scene2017("<entity file=ship.xml/><background texture=b.jpg/>"));
    checkRoundTrip(
        scene2020("<models><model command=\"box 1\" diffuse=\"c\" ambient=\"rgb\"/>"
                  "</models><lights><light type=\"POINT\" attenuation=\"0.1\"/>"
                  "</lights>"));
    checkRoundTrip("<scene camX=1 camY=2 yaw=33 pitch=-12.5/>");
    // Longer than a title may be, by attribute and with a blank where it is cut.
    checkRoundTrip("<world title=\"" + std::string(199, 't') + " title\"/>");
    checkRoundTrip("<world><title>" + std::string(199, 't') + " title</title></world>");
    checkRoundTrip(transform("<translate x=1/><translate x=2/>"));
}

TEST_CASE("canonical XML is read without a word") {
    const Outcome first = tryRead(everything(), {}, kFiles);
    INFO(first.text());
    const Outcome second = tryRead(write(*first.scene), {}, kFiles);
    INFO(second.text());
    CHECK(second.diagnostics.empty());
}

TEST_CASE("equality sees every field") {
    const Scene scene = *tryRead(everything(), {}, kFiles).scene;
    CHECK(equal(scene, scene));
    const std::function<void(Scene&)> changes[] = {
        [](Scene& s) { s.dialect = Dialect::engine2020; },
        [](Scene& s) { s.title += "x"; },
        [](Scene& s) { s.description += "x"; },
        [](Scene& s) { s.window->width = 1; },
        [](Scene& s) { s.camera.reset(); },
        [](Scene& s) { s.camera->up.z = 0.5; },
        [](Scene& s) { s.lights[0].position.x = 9; },
        [](Scene& s) { s.lights[3].exponent = 9; },
        [](Scene& s) { s.lights[2].space = LightSpace::world; },
        [](Scene& s) { s.globalAmbient.r = 0; },
        [](Scene& s) { s.settings.samples = 2; },
        [](Scene& s) { s.settings.transparency = Transparency::off; },
        [](Scene& s) { s.settings.shadows = Shadows::off; },
        [](Scene& s) { s.background.color->r = 0; },
        [](Scene& s) { s.skybox->width = 1; },
        [](Scene& s) { s.entity.reset(); },
        [](Scene& s) { s.generatorComments.clear(); },
        [](Scene& s) { s.groups[0].name.clear(); },
        [](Scene& s) { s.groups[0].transforms.pop_back(); },
        [](Scene& s) { s.groups[0].transforms[0] = Scale{}; },
        [](Scene& s) { s.groups[0].scatter->seed = 99; },
        [](Scene& s) { s.groups[0].models[1].autoLod = false; },
        [](Scene& s) { s.groups[0].models[1].opacity = 1; },
        [](Scene& s) { s.groups[0].models[2].material->opacity = 1; },
        [](Scene& s) { s.groups[0].models[2].material->shininess = 1; },
        [](Scene& s) { s.groups[0].models[2].texture->planeS.x = 9; },
        [](Scene& s) { s.groups[0].models[3].texture->chess->rows = 1; },
        [](Scene& s) { s.groups[0].groups[0].lights.clear(); },
    };
    for (const auto& change : changes) {
        Scene other = scene;
        change(other);
        CHECK_FALSE(equal(scene, other));
    }
    Scene moved = scene;
    moved.groups[0].where.line = 99;
    CHECK(equal(scene, moved));
}

TEST_CASE("numbers are written so that they read back equal") {
    for (const double value : {0.1, 1.0 / 3.0, 1e-30, 123456789.123456789, -2.5, 1e18, 512.0})
        CHECK(parseNumber(formatNumber(value)).value == value);
    CHECK(formatNumber(-0.0) == "0");
    CHECK(formatNumber(512) == "512");
}

/// A decimal comma for C++ streams, on systems without a locale that has one.
struct CommaPunctuation : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
};

TEST_CASE("reading and writing do not depend on the locale of streams") {
    const std::locale before =
        std::locale::global(std::locale(std::locale(), new CommaPunctuation));
    CHECK(tryRead(transform("<translate x=\"1.5\"/>")).scene);
    CHECK(tryRead(transform("<translate x=\"1,5\"/>")).find("scene.number") != nullptr);
    CHECK(formatNumber(1.5) == "1.5");
    std::locale::global(before);
}

TEST_CASE("reading and writing do not depend on the locale") {
    const std::string folder = farol::test::commaLocale();
    const std::string before = std::setlocale(LC_ALL, nullptr);
    setenv("LOCPATH", folder.c_str(), 1);
    const char* comma = std::setlocale(LC_ALL, farol::test::kCommaLocale);
    unsetenv("LOCPATH");
    REQUIRE(comma != nullptr);
    CHECK(tryRead(transform("<translate x=\"1.5\"/>")).scene);
    CHECK(tryRead(transform("<translate x=\"1,5\"/>")).find("scene.number") != nullptr);
    CHECK(formatNumber(1.5) == "1.5");
    std::setlocale(LC_ALL, before.c_str());
}
