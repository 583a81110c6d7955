#include <catch2/catch.hpp>

#include "tests/accuracy/measure.h"

using namespace farol;
using namespace farol::accuracy;

namespace {

struct Case {
    std::string name, xml;
    double timeS = 0.0;
};

const std::string kCamera =
    R"(<camera><position x="6" y="5" z="9"/><lookAt x="0" y="0.5" z="0"/>
       <projection fov="45" near="1" far="100"/></camera>)";
const std::string kShiny =
    R"(<color><diffuse R="90" G="140" B="200"/><ambient R="30" G="25" B="20"/>
       <specular R="200" G="200" B="180"/><shininess value="30"/></color>)";

std::string model(const std::string& file) {
    return "<models><model file=\"" + file + "\">" + kShiny + "</model></models>";
}

std::string world(const std::string& lights, const std::string& groups,
                  const std::string& camera = kCamera) {
    return "<world><window width=\"300\" height=\"220\"/>" + camera + "<lights>" + lights +
           "</lights>" + groups + "</world>";
}

const std::string kSun = R"(<light type="directional" dirx="1" diry="2" dirz="1.5"/>)";

std::vector<Case> cases() {
    std::vector<Case> all;
    all.push_back(
        {"hierarchy",
         world(kSun + R"(<light type="point" posx="1" posy="4" posz="3" quadratic="0.05"/>)",
               R"(<group><transform><rotate angle="30" x="0" y="1" z="0"/>
                  <scale x="1.5" y="1" z="0.7"/></transform>)" +
                   model("torus_1.6_0.3_256_128.3d") +
                   R"(<group><transform><translate x="0.5" y="1" z="0"/>
                      <rotate angle="50" x="1" y="0" z="1"/></transform>)" +
                   model("cone_0.6_1.4_256_64.3d") +
                   R"(<group><transform><translate x="1" y="0.5" z="0"/>
                      <scale x="0.4" y="-0.4" z="0.4"/></transform>)" +
                   model("sphere_1_256_128.3d") + "</group></group></group>")});
    // Motion: a spin, and a lap along a curve that it is aligned with.
    all.push_back({"motion",
                   world(kSun, R"(<group><transform><translate time="10" align="true">
             <point x="3" y="0" z="0"/><point x="0" y="1" z="3"/><point x="-3" y="0" z="0"/>
             <point x="0" y="-1" z="-3"/></translate><rotate time="4" x="1" y="1" z="0"/>
             </transform>)" + model("box_1_2_1.5.3d") +
                                   "</group><group>" + model("sphere_1_256_128.3d") + "</group>"),
                   1.7});
    // A light of a group lights its own only.
    all.push_back({"group lights", R"(<scene><window width="300" height="220"/>)" + kCamera + R"(
            <lights><light type="point" posX="5" posY="5" posZ="5"/></lights>
            <group><translate X="2"/><lights><light type="point" posX="0" posY="3" posZ="1"
             diffR="1" diffG="0.2" diffB="0.1"/></lights><models>
             <model file="sphere_1_256_128.3d" diffR="0.7" diffG="0.7" diffB="0.7" specR="0.3"
              shininess="20"/></models></group>
            <group><translate X="-2"/><models><model file="sphere_1_256_128.3d" diffR="0.5"
             diffG="0.6" diffB="0.9"/></models></group></scene>)"});
    // The same, a million units away: eight digits of a float are not enough for that.
    all.push_back(
        {"a million away",
         world(kSun + R"(<light type="point" posx="1000001" posy="4" posz="3"/>)",
               R"(<group><transform><translate x="1000000" y="0" z="0"/></transform>)" +
                   model("torus_1.6_0.5_256_128.3d") + model("sphere_0.8_256_128.3d") + "</group>",
               R"(<camera><position x="1000006" y="5" z="9"/><lookAt x="1000000" y="0.5" z="0"/>
                  <projection fov="45" near="1" far="100"/></camera>)")});
    // A wide view and a light inside the scene.
    all.push_back(
        {"wide view", world(R"(<light type="point" posx="0" posy="2" posz="0" linear="0.2"/>)",
                            "<group>" + model("plane_12.3d") + model("cylinder_0.5_1_256_1.3d") +
                                R"(<group><transform><translate x="-3" y="1" z="1"/></transform>)" +
                                model("sphere_1_256_128.3d") + "</group></group>",
                            R"(<camera><position x="1" y="3" z="4"/><lookAt x="0" y="0.5" z="0"/>
                  <projection fov="110" near="0.5" far="100"/></camera>)")});
    // The other dialects' own: copies at random, planes seen from below, materials left out.
    all.push_back(
        {"2017 ring of copies", R"(<scene><window width="300" height="220"/>)" + kCamera + R"(
            <lights><light type="point" posX="5" posY="5" posZ="5"/></lights><group><models>
            <model rand="20" xzminr="1" xzmaxr="3.5" yminr="-1" ymaxr="1"
             file="sphere_0.5_128_64.3d" diffR="0.5" diffG="0.6" diffB="0.7"/></models></group>
            </scene>)"});
    all.push_back(
        {"2017 plane from below",
         R"(<scene><window width="300" height="220"/><camera><position x="2" y="-5" z="9"/>
            <lookAt x="0" y="0.5" z="0"/><projection fov="45" near="1" far="100"/></camera>
            <lights><light type="point" posX="5" posY="-5" posZ="5"/></lights><group><models>
            <model file="plane_6.3d" diffR="0.5" diffG="0.6" diffB="0.7" specR="0.5"
             shininess="10"/></models></group></scene>)"});
    all.push_back({"2020 colours", R"(<scene><window width="300" height="220"/>)" + kCamera + R"(
            <colors><color name="k" r="0.3" g="0.9" b="0.2" a="1"/></colors>
            <lights><light type="SPOT" posX="5" posY="5" posZ="5" dirX="-1" dirY="-1" dirZ="-1"
             cutoff="12" diffuse="k"/><light type="POINT" posX="0" posY="5" posZ="2"
             attenuation="0.02"/></lights><group><models><model command="sphere 2 256 128"
             diffuse="k" ambient="rgb"/></models></group></scene>)",
                   0.7});
    // Unlit: the diffuse colour alone.
    all.push_back({"unlit", "<world><window width=\"300\" height=\"220\"/>" + kCamera + "<group>" +
                                model("sphere_1_256_128.3d") + "</group></world>"});
    return all;
}

}  // namespace

TEST_CASE("whole scenes are the exact ones to the rounding of a byte") {
    for (const Case& one : cases())
        for (const bool local : {false, true}) {
            render::PictureOptions options;
            options.samples = 1;
            options.timeS = one.timeS;
            options.viewer = local ? scene::Viewer::local : scene::Viewer::infinite;
            options.specular = local ? scene::Specular::separate : scene::Specular::single;
            const Figures figures = measure(one.xml, options);
            print(one.name, figures);
            INFO(one.name);
            REQUIRE(figures.interior.pixels > 1000);
            CHECK(figures.stray == 0);
            // As for the single shapes: rounding is 0.29, and meshes of 256 slices hardly more.
            CHECK(figures.interior.rms < 0.33);
            CHECK(figures.interior.percentile999 < 1.5);
            CHECK(figures.flipped < 0.02 * figures.silhouette.pixels);
        }
}
