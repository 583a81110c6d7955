#include <random>

#include "interchange/material.h"
#include "interchange/placement.h"
#include "interchange/write.h"
#include "scene/animation.h"
#include "tests/unit/interchange/gltf_file.h"

using namespace farol;
using namespace farol::interchange;
using nlohmann::json;

namespace {

render::Job jobOf(const std::string& xml, std::map<std::string, std::string> files = {}) {
    render::Job job;
    job.xml = xml;
    job.assets = std::make_shared<scene::BundleAssets>(std::move(files));
    return job;
}

WrittenScene glb(const std::string& xml) { return writeGlb(jobOf(xml), kMaxModelBytes); }

bool hasCode(const Diagnostics& all, const std::string& code, const std::string& words) {
    return std::any_of(all.begin(), all.end(), [&](const Diagnostic& one) {
        return one.code == code && one.message.find(words) != std::string::npos;
    });
}

double display(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

constexpr const char* kLit = R"(<lights><light type="directional" dirX="1" dirY="1"/></lights>)";

}  // namespace

TEST_CASE("groups are nodes with their names, and models of one source share a mesh") {
    const WrittenScene written = glb(std::string("<world>") + kLit + R"(
        <group name="outer"><transform><translate x="1"/></transform>
          <models><model file="box_1_2.3d"/><model command="box 1 2" name="second"/></models>
          <group name="inner"><transform><rotate angle="90" y="1"/></transform>
            <models><model file="box_1_2.3d"><color><diffuse R="255" G="0" B="0"/></color></model></models>
          </group></group></world>)");
    const test::GltfFile file(written.bytes);
    const json* outer = file.find("nodes", "outer");
    REQUIRE(outer != nullptr);
    CHECK((*outer)["translation"] == json::array({1.0, 0.0, 0.0}));
    CHECK((*outer)["children"].size() == 3);
    REQUIRE(file.find("nodes", "inner") != nullptr);
    CHECK(file.find("nodes", "second")->at("mesh") == file.find("nodes", "box_1_2.3d")->at("mesh"));
    // Another material is another mesh of the same accessors.
    CHECK(written.meshes == 2);
    const json& a = file.json["meshes"][0]["primitives"][0];
    const json& b = file.json["meshes"][1]["primitives"][0];
    CHECK(a["attributes"] == b["attributes"]);
    CHECK(a["indices"] == b["indices"]);
    CHECK(a["material"] != b["material"]);
    const json& positions = file.json["accessors"][a["attributes"]["POSITION"].get<std::size_t>()];
    CHECK(positions["min"] == json::array({-0.5, -0.5, -0.5}));
    CHECK(positions["max"] == json::array({0.5, 0.5, 0.5}));
}

TEST_CASE("the same scene gives the same bytes") {
    const std::string xml = std::string("<world>") + kLit +
                            R"(<group><transform><rotate time="3" y="1"/></transform><models>
        <model file="sphere_1.3d"><texture file="chess:4x4"/></model></models></group></world>)";
    CHECK(glb(xml).bytes == glb(xml).bytes);
}

TEST_CASE("a chain of nodes has the product of any transforms") {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-2.0, 2.0);
    const auto vector = [&] { return glm::dvec3(number(random), number(random), number(random)); };
    for (int i = 0; i < 300; ++i) {
        std::vector<scene::Transform> transforms;
        for (int k = static_cast<int>(random() % 7); k > 0; --k) switch (random() % 5) {
                case 0:
                    transforms.emplace_back(scene::Translate{vector()});
                    break;
                case 1:
                    transforms.emplace_back(scene::Rotate{100.0 * number(random), vector()});
                    break;
                case 2:
                    transforms.emplace_back(scene::Scale{vector()});
                    break;
                case 3:
                    transforms.emplace_back(scene::Spin{number(random) < 0 ? -3.0 : 2.0, vector()});
                    break;
                default: {
                    scene::FollowCurve curve{5.0, random() % 2 == 0, {}};
                    for (int p = 0; p < 5; ++p) curve.points.push_back(vector());
                    transforms.emplace_back(std::move(curve));
                }
            }
        glm::dmat4 product(1.0);
        for (const Placement& node : placementsOf(transforms, 0.7)) {
            const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), node.translation);
            product *= glm::scale(moved * glm::mat4_cast(node.rotation), node.scale);
        }
        const glm::dmat4 expected = scene::matrixAt(transforms, 0.7);
        for (int k = 0; k < 4; ++k)
            CHECK(glm::distance(product[k], expected[k]) < 1e-9 * (1.0 + glm::length(expected[k])));
    }
}

TEST_CASE("few nodes stand for the usual order of transforms") {
    using namespace scene;
    const std::vector<Transform> usual{Translate{{1, 2, 3}}, Rotate{30, {0, 1, 0}},
                                       Scale{{2, 1, 1}}};
    CHECK(placementsOf(usual, 0.0).size() == 1);
    CHECK(placementsOf({Translate{{1, 2, 3}}, Spin{4, {0, 1, 0}}, Scale{{2, 1, 1}}}, 0.0).size() ==
          1);
    CHECK(placementsOf({Rotate{30, {0, 1, 0}}, Translate{{1, 2, 3}}}, 0.0).size() == 1);
    CHECK(placementsOf({Scale{{2, 1, 1}}, Rotate{30, {0, 1, 0}}}, 0.0).size() == 2);
    CHECK(placementsOf({}, 0.0).size() == 1);
}

TEST_CASE("sampled turns are exact, and sampled curves err by less than their bound") {
    const std::string xml = std::string("<world>") + kLit + R"(
      <group name="turn"><transform><translate x="2"/><rotate time="-7" x="1" y="2"/></transform>
        <models><model file="box_1.3d"/></models></group>
      <group name="lap"><transform><translate time="5" align="true"><point x="4"/><point z="3"/>
        <point x="-4" y="1"/><point z="-3"/></translate></transform>
        <models><model file="box_1.3d"/></models></group></world>)";
    const WrittenScene written = glb(xml);
    const test::GltfFile file(written.bytes);
    const json& nodes = file.json["nodes"];
    scene::FollowCurve curve{5.0, true, {{4, 0, 0}, {0, 0, 3}, {-4, 1, 0}, {0, 0, -3}}};
    const std::vector<scene::Transform> turn{scene::Translate{{2, 0, 0}},
                                             scene::Spin{-7.0, {1, 2, 0}}};
    const double diagonal = glm::length(glm::dvec3(8, 1, 6));
    double worst = 0.0, worstTurn = 0.0;
    for (std::size_t node = 0; node < nodes.size(); ++node)
        for (int i = 0; i < 700; ++i) {
            const double timeS = 35.0 * i / 700.0;  // one loop of both
            if (nodes[node].value("name", "") == "turn")
                for (int k = 0; k < 4; ++k)
                    CHECK(glm::distance(file.matrixAt(node, timeS)[k],
                                        scene::matrixAt(turn, timeS)[k]) < 1e-4);
            if (nodes[node].value("name", "") != "lap") continue;
            const glm::dmat4 at = file.matrixAt(node, timeS),
                             exact = scene::matrixAt(scene::Transform(curve), timeS);
            worst = std::max(worst, glm::distance(at[3], exact[3]));
            for (int k = 0; k < 3; ++k)
                worstTurn = std::max(worstTurn, glm::distance(at[k], exact[k]));
        }
    CHECK(worst > 0.0);
    CHECK(worst < kCurveError * diagonal + 1e-5);
    CHECK(worstTurn < 0.02);
    CHECK(written.animations == 3);
    const json& input =
        file.json["accessors"]
                 [file.json["animations"][0]["samplers"][0]["input"].get<std::size_t>()];
    CHECK(input["min"] == json::array({0.0}));
    CHECK(input["max"] == json::array({35.0}));
}

TEST_CASE("motions without a common loop last as long as the longest") {
    const WrittenScene written = glb(std::string("<world>") + kLit + R"(
      <group><transform><rotate time="1234.567" y="1"/></transform><models><model file="box_1.3d"/></models></group>
      <group><transform><rotate time="987.643" y="1"/></transform><models><model file="box_1.3d"/></models></group>
      </world>)");
    const test::GltfFile file(written.bytes);
    CHECK(hasCode(written.diagnostics, "convert.approximated", "motions"));
    const std::size_t input = file.json["animations"][0]["samplers"][0]["input"];
    CHECK(file.json["accessors"][input]["max"][0].get<double>() == Approx(1234.567));
}

TEST_CASE("a material keeps its colours in the dark and in full light") {
    PhongColors colors;
    colors.base = {0.2F, 0.1F, 0.0F};
    colors.diffuse = {0.5F, 0.9F, 0.3F};
    const PbrMaterial pbr = pbrOf(colors);
    for (int k = 0; k < 3; ++k) {
        CHECK(display(double{pbr.emissive[k]}) == Approx(double{colors.base[k]}).margin(1e-5));
        // baseColor / pi, by a light of pi lux.
        const double lit =
            double{pbr.emissive[k]} + double{pbr.baseColor[k]} / 3.14159265 * kUnitLight;
        CHECK(display(lit) ==
              Approx(std::min(1.0, double{colors.base[k] + colors.diffuse[k]})).margin(1e-5));
    }
    CHECK(pbr.reflectance == glm::vec3(0.0F));
    CHECK(pbr.roughness == 1.0F);
}

TEST_CASE("a highlight has the height of Blinn-Phong's at its middle") {
    for (const float shininess : {1.0F, 12.0F, 128.0F}) {
        PhongColors colors;
        colors.specular = {0.5F, 0.25F, 0.0F};
        colors.shininess = shininess;
        const PbrMaterial pbr = pbrOf(colors);
        const double alpha = std::pow(double{pbr.roughness}, 2.0);
        CHECK(2.0 / (alpha * alpha) - 2.0 == Approx(double{shininess}).epsilon(1e-4));
        for (int k = 0; k < 3; ++k) {
            const double f0 = double{pbr.reflectance[k]};
            // D V F at normal incidence, V = 1/4; times the light's pi lux.
            const double peak = f0 / (3.14159265 * alpha * alpha) / 4.0 * kUnitLight;
            CHECK(peak == Approx(double{linearOf(colors.specular[k])}).epsilon(1e-3).margin(1e-6));
        }
    }
}

// Blender 3 reads specularColorFactor and not specularFactor, and has no F0 of 1.
TEST_CASE("the colour of a highlight has its strength") {
    const test::GltfFile file(glb(std::string("<world>") + kLit + R"(<group><models>
      <model file="box_1.3d"><color><specular R="255" G="255" B="255"/><shininess value="30"/></color></model>
      <model file="box_1.3d"><color><specular R="0" G="0" B="0"/><shininess value="30"/></color></model>
      <model file="box_1.3d"><color><specular R="255" G="255" B="255"/><shininess value="0"/></color></model>
      </models></group></world>)")
                                  .bytes);
    REQUIRE(file.json["materials"].size() == 3);
    const auto specularOf = [&](std::size_t k) {
        return file.json["materials"][k]["extensions"]["KHR_materials_specular"];
    };
    CHECK(specularOf(0).value("specularFactor", 1.0) == 1.0);
    CHECK(0.04 * specularOf(0)["specularColorFactor"][1].get<double>() == Approx(8.0 / 32.0));
    CHECK(specularOf(1)["specularFactor"] == 0);
    CHECK(specularOf(1)["specularColorFactor"] == json::array({0.0, 0.0, 0.0}));
    CHECK(0.04 * specularOf(2)["specularColorFactor"][1].get<double>() < 0.96);
}

TEST_CASE("lights are punctual lights, facing their way") {
    const WrittenScene written = glb(R"(<world><lights>
      <light type="directional" dirX="0" dirY="1" dirZ="0"/>
      <light type="point" posX="1" posY="2" posZ="3" constant="0" quadratic="0.5"/>
      <light type="spot" posY="4" dirY="-1" cutoff="60" exponent="2"/></lights>
      <group><models><model file="box_1.3d"/></models></group></world>)");
    const test::GltfFile file(written.bytes);
    const json& lights = file.json["extensions"]["KHR_lights_punctual"]["lights"];
    REQUIRE(lights.size() == 3);
    CHECK(lights[0]["intensity"].get<double>() == Approx(kUnitLight));
    CHECK(lights[1]["intensity"].get<double>() == Approx(2.0 * kUnitLight));
    CHECK(lights[2]["spot"]["outerConeAngle"].get<double>() == Approx(1.0471976));
    // The light shines along -Z of its node.
    const std::vector<double> q = file.find("nodes", "directional")->at("rotation");
    const glm::dvec3 along = glm::dquat(q[3], q[0], q[1], q[2]) * glm::dvec3(0, 0, -1);
    CHECK(glm::distance(along, glm::dvec3(0, -1, 0)) < 1e-9);
    CHECK(hasCode(written.diagnostics, "convert.approximated", "exponent"));
    CHECK(hasCode(written.diagnostics, "convert.approximated", "attenuation"));
}

TEST_CASE("a scene without lights is unlit, and one without colours is its edges") {
    const test::GltfFile solid(glb(R"(<world><group><models><model file="box_1.3d">
      <color><diffuse R="255" G="0" B="0"/></color></model></models></group></world>)")
                                   .bytes);
    CHECK(solid.json["materials"][0]["extensions"].contains("KHR_materials_unlit"));
    CHECK(solid.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] ==
          json::array({1.0, 0.0, 0.0, 1}));
    const test::GltfFile lines(
        glb(R"(<world><group><models><model file="box_1.3d"/></models></group></world>)").bytes);
    const json& primitive = lines.json["meshes"][0]["primitives"][0];
    CHECK(primitive["mode"] == 1);
    // 24 vertices, 12 triangles: 4 edges and a diagonal a face.
    CHECK(lines.json["accessors"][primitive["indices"].get<std::size_t>()]["count"] == 60);
}

TEST_CASE("texture coordinates run from the top, and the seam of a projection is split") {
    const test::GltfFile file(glb(std::string("<world>") + kLit + R"(<group><models>
      <model file="sphere_1_16_8.3d"><texture file="chess:2x2" mapping="sphere"/></model>
      <model file="plane_2_1.3d"><texture file="chess:2x2"/></model></models></group></world>)")
                                  .bytes);
    REQUIRE(file.json["images"].size() == 1);
    CHECK(file.json["images"][0]["mimeType"] == "image/png");
    const json& sphere = file.json["meshes"][0]["primitives"][0]["attributes"];
    const std::vector<float> p = file.floats(sphere["POSITION"]),
                             uv = file.floats(sphere["TEXCOORD_0"]);
    for (std::size_t i = 0; i < uv.size() / 2; ++i)
        CHECK(double{uv[2 * i + 1]} ==
              Approx(0.5 - std::asin(std::clamp(double{p[3 * i + 1]}, -1.0, 1.0)) / 3.14159265)
                  .margin(1e-3));
    const json& indices =
        file.json["accessors"]
                 [file.json["meshes"][0]["primitives"][0]["indices"].get<std::size_t>()];
    const json& view = file.json["bufferViews"][indices["bufferView"].get<std::size_t>()];
    for (std::size_t i = 0; i < indices["count"].get<std::size_t>(); i += 3) {
        float low = 9.0F, high = -9.0F;
        for (std::size_t k = 0; k < 3; ++k) {
            std::uint16_t index = 0;
            std::memcpy(&index,
                        file.bytes.data() + view["byteOffset"].get<std::size_t>() + 2 * (i + k), 2);
            low = std::min(low, uv[2 * index]);
            high = std::max(high, uv[2 * index]);
        }
        CHECK(high - low <= 0.5F);
    }
}

TEST_CASE("images and materials have the names of their textures") {
    const std::string pixel = "P6 1 1 255\n\x80\x40\x20";
    const test::GltfFile file(writeGlb(jobOf(std::string("<world>") + kLit + R"(<group><models>
      <model file="box_1.3d"><texture file="wood/old.oak.ppm"/></model>
      <model file="box_1.3d"><texture file="wood/old.oak.ppm"/></model>
      <model file="box_1.3d"/></models></group></world>)",
                                             {{"wood/old.oak.ppm", pixel}}),
                                       kMaxModelBytes)
                                  .bytes);
    REQUIRE(file.json["images"].size() == 1);
    CHECK(file.json["images"][0].value("name", "") == "old.oak");
    REQUIRE(file.json["materials"].size() == 2);
    CHECK(file.json["materials"][0].value("name", "") == "old.oak");
    CHECK_FALSE(file.json["materials"][1].contains("name"));
}

TEST_CASE("models over their bounds are refused") {
    const std::string xml =
        R"(<world><group><models><model file="sphere_1_64_64.3d"/></models></group></world>)";
    CHECK_NOTHROW(writeGlb(jobOf(xml), 1 << 20));
    for (const std::size_t bytes : {std::size_t{10}, std::size_t{20'000}}) {
        try {
            writeGlb(jobOf(xml), bytes);
            FAIL("no error");
        } catch (const Error& error) {
            CHECK(error.code() == "limit.model");
        }
    }
    CHECK_THROWS_AS(writeObj(jobOf(xml), "x", 1000), Error);
}

TEST_CASE("scales beyond what a float holds are refused, not written as infinity") {
    const std::string scale = "<scale x=\"1e18\" y=\"1\" z=\"1\"/>";
    const std::string xml =
        "<world><group><transform>" + scale + scale + scale +
        "</transform><models><model command=\"box 1\"/></models></group></world>";
    for (const bool isGlb : {true, false}) {
        try {
            isGlb ? writeGlb(jobOf(xml), 1 << 20) : writeObj(jobOf(xml), "x", 1 << 20);
            FAIL("no error");
        } catch (const Error& error) {
            CHECK(error.code() == "limit.model");
            CHECK_THAT(error.what(), Catch::Contains("3.4e+38"));
        }
    }
}

TEST_CASE("names of any bytes make a valid document") {
    const WrittenScene written =
        glb("<world><group name=\"\xff\xfe&quot;\"><models><model file=\"box_1.3d\" "
            "name=\"a\xc3\x28\"/></models></group></world>");
    CHECK_NOTHROW(test::GltfFile(written.bytes));
}

TEST_CASE("opacity is the alpha of the base colour, unless the scene draws without it") {
    for (const bool isOff : {false, true}) {
        const WrittenScene written = glb(std::string("<world><render transparency=\"") +
                                         (isOff ? "off" : "on") + "\"/>" + kLit + R"(<group><models>
            <model command="sphere 1" opacity="0.5"/></models></group></world>)");
        const test::GltfFile file(written.bytes);
        const json& material = file.json["materials"][0];
        CAPTURE(isOff, material.dump());
        CHECK(material["pbrMetallicRoughness"]["baseColorFactor"][3] == (isOff ? 1.0 : 0.5));
        CHECK(material.contains("alphaMode") == !isOff);
    }
}
