#include "render/plan/visibility.h"

#include <catch2/catch.hpp>

#include "render/renderer.h"
#include "tests/support/plan_scene.h"

using namespace farol;

namespace {

/// The findings that `validate` and a render of the scene give about visibility and lights.
Diagnostics findingsOf(const std::string& xml, bool validates) {
    render::Job job;
    job.xml = xml;
    job.assets = std::make_shared<scene::BundleAssets>();
    Diagnostics out;
    static render::Renderer renderer;
    const Diagnostics all =
        validates ? render::inspect(job).diagnostics : renderer.render(job).diagnostics;
    for (const Diagnostic& finding : all)
        if (finding.code == "scene.blank" || finding.code.starts_with("scene.light-"))
            out.push_back(finding);
    return out;
}

std::string world(const std::string& camera, const std::string& lights, const std::string& groups) {
    return "<world><window width=\"64\" height=\"64\"/><camera>" + camera + "</camera><lights>" +
           lights + "</lights>" + groups + "</world>";
}

std::string group(const std::string& transforms, const std::string& file,
                  const std::string& color = "") {
    return "<group><transform>" + transforms + "</transform><models><model file=\"" + file + "\">" +
           color + "</model></models></group>";
}

const std::string kCamera =
    R"(<position x="0" y="0" z="5"/><lookAt x="0" y="0" z="0"/><projection fov="60" near="1" far="100"/>)";
const std::string kSun = R"(<light type="directional" dirx="1" diry="1" dirz="1"/>)";
const std::string kBox = "box_1_1.3d";

struct Row {
    std::string name, xml, code, part;
};

const std::vector<Row>& rows() {
    static const std::vector<Row> all{
        {"behind", world(kCamera, kSun, group(R"(<translate x="0" y="0" z="9"/>)", kBox)),
         "scene.blank", "behind the camera at 0 0 5; set its lookAt to 0 0 9"},
        {"before near",
         world(kCamera, kSun,
               group(R"(<translate x="0" y="0" z="4.5"/><scale x=".1" y=".1" z=".1"/>)", kBox)),
         "scene.blank", "near plane of the camera (1)"},
        {"beyond far", world(kCamera, kSun, group(R"(<translate x="0" y="0" z="-200"/>)", kBox)),
         "scene.blank", "far plane of the camera (100)"},
        {"beside", world(kCamera, kSun, group(R"(<translate x="50" y="0" z="0"/>)", kBox)),
         "scene.blank", "outside the view of the camera; set its lookAt to 50 0 0"},
        {"too small", world(kCamera, kSun, group(R"(<scale x=".001" y=".001" z=".001"/>)", kBox)),
         "scene.blank", "smaller than a pixel"},
        {"no size", world(kCamera, kSun, group(R"(<scale x="0" y="0" z="0"/>)", kBox)),
         "scene.blank", "without any size"},
        {"inside",
         world(kCamera, kSun,
               group(R"(<translate x="0" y="0" z="5"/><scale x="20" y="20" z="20"/>)", kBox)),
         "scene.blank", "around the camera"},
        {"back faces",
         world(R"(<position x="0" y="-3" z="1"/><lookAt x="0" y="0" z="0"/>)", kSun,
               group("", "plane_1_1.3d")),
         "scene.blank", "seen from the back"},
        {"black",
         world(kCamera, kSun,
               group("", kBox,
                     R"(<color><diffuse R="0" G="0" B="0"/><ambient R="0" G="0" B="0"/></color>)")),
         "scene.blank", "black"},
        {"unlit",
         world(
             kCamera,
             R"(<light type="spot" posx="0" posy="9" posz="0" dirx="0" diry="1" dirz="0" cutoff="20"/>)",
             group("", kBox,
                   R"(<color><diffuse R="200" G="0" B="0"/><ambient R="0" G="0" B="0"/></color>)")),
         "scene.blank", "reached by no light"},
        {"from below",
         world(kCamera, R"(<light type="directional" dirx="0" diry="-1" dirz="0"/>)",
               group("", kBox)),
         "scene.light-below", "did you mean 0 1 0?"},
        {"light inside",
         world(kCamera, R"(<light type="point" posx="0" posy="0" posz="0"/>)",
               group("", "sphere_1_16_16.3d")),
         "scene.light-inside", "at line 1, is inside it"},
        {"unused light",
         world(
             kCamera, kSun,
             R"(<group><lights><light type="point" posx="0" posy="5" posz="0"/></lights></group>)" +
                 group("", kBox)),
         "scene.light-unused", "has no effect"},
    };
    return all;
}

}  // namespace

TEST_CASE("a reason why nothing shows is found, by a render and by validate alike") {
    for (const Row& row : rows())
        for (const bool validates : {false, true}) {
            INFO(row.name << (validates ? ", validate" : ", render"));
            const Diagnostics findings = findingsOf(row.xml, validates);
            REQUIRE(findings.size() == 1);
            CHECK(findings[0].code == row.code);
            CHECK(findings[0].severity == Severity::warning);
            CHECK_THAT(findings[0].message, Catch::Contains(row.part));
            CHECK(findings[0].where.line == 1);
        }
}

TEST_CASE("a scene that shows draws no such warning") {
    for (const std::string& xml :
         {world(kCamera, kSun, group("", kBox)), world(kCamera, "", group("", kBox)),
          // A lamp inside its own glowing ball, and a second light on the ball.
          world(kCamera, R"(<light type="point" posx="0" posy="0" posz="0"/>)",
                group("", "sphere_1_16_16.3d",
                      R"(<color><emissive R="255" G="255" B="0"/></color>)")),
          world(kCamera, R"(<light type="point" posx="0" posy="0" posz="0"/>)" + kSun,
                group("", "sphere_1_16_16.3d")),
          // White that fills the image is no fault that is known.
          world(R"(<position x="0" y="0" z="1.6"/><lookAt x="0" y="0" z="0"/>)", kSun,
                group(R"(<scale x="9" y="9" z="1"/>)", kBox,
                      R"(<color><emissive R="255" G="255" B="255"/></color>)"))})
        for (const bool validates : {false, true}) {
            INFO(xml);
            CHECK(findingsOf(xml, validates).empty());
        }
}

TEST_CASE("several models are counted") {
    const auto findings = findingsOf(world(kCamera, kSun,
                                           group(R"(<translate x="0" y="0" z="9"/>)", kBox) +
                                               group(R"(<translate x="0" y="0" z="19"/>)", kBox) +
                                               group(R"(<translate x="99" y="0" z="0"/>)", kBox)),
                                     true);
    REQUIRE(findings.size() == 2);
    CHECK_THAT(findings[0].message, Catch::Contains("2 of 3 models are behind"));
    CHECK_THAT(findings[1].message, Catch::Contains("this model is outside"));
}
