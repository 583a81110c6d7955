#include <catch2/catch.hpp>

#include "tests/accuracy/measure.h"
#include "tests/accuracy/pattern.h"

using namespace farol;
using namespace farol::accuracy;

namespace {

struct Case {
    std::string name, model;
};

std::string document(const std::string& model) {
    return R"(<world><window width="300" height="300"/>
        <camera><position x="2.2" y="1.9" z="3.1"/><lookAt x="0" y="0.2" z="0"/>
        <projection fov="50" near="1" far="100"/></camera>
        <lights><light type="directional" dirx="1" diry="2" dirz="1.5"/></lights>
        <group><transform><rotate angle="20" x="1" y="0" z="0.5"/></transform><models>)" +
           model + "</models></group></world>";
}

std::string textured(const std::string& attributes, const std::string& extra = "") {
    return "<model " + attributes + "><texture file=\"it.png\"/>" + extra +
           R"(<color><diffuse R="180" G="190" B="200"/><specular R="90" G="90" B="90"/>
              <shininess value="20"/></color></model>)";
}

std::vector<Case> cases() {
    return {
        {"box atlas", textured(R"(file="box_1.4_3.3d" uv="atlas")")},
        {"cylinder atlas", textured(R"(file="cylinder_0.8_1_256_1.3d" uv="atlas")")},
        {"cone atlas", textured(R"(file="cone_1_1.5_256_16.3d" uv="atlas")")},
        {"frustum atlas", textured(R"(file="frustum_0.5_1_1_256_8.3d" uv="atlas")")},
        {"ring", textured(R"(file="ring_0.4_1.2_512.3d")")},
        {"ellipsoid", textured(R"(file="ellipsoid_1.2_0.7_0.9_256_128.3d")")},
        {"revolution", textured(R"(command="revolution profile.ply 513")")},
        {"texgen object", textured(R"(file="torus_1_0.4_256_128.3d")",
                                   R"(<texgen mode="object" s="0.5 0.2 0 0.1" t="0 0.4 0.3 0"/>)")},
        {"texgen eye", textured(R"(file="torus_1_0.4_256_128.3d")",
                                R"(<texgen mode="eye" s="0.5 0.2 0 0.1" t="0 0.4 0.3 0"/>)")},
        {"sphere mapping", textured(R"(file="box_1.4_3.3d" mapping="sphere")")},
    };
}

}  // namespace

TEST_CASE("every way to lay a texture gives the exact pictures") {
    const Supplies given = supplies(256, 192);
    for (const Case& one : cases())
        for (const bool separate : {false, true}) {
            render::PictureOptions options;
            options.samples = 1;
            options.specular = separate ? scene::Specular::separate : scene::Specular::single;
            const Figures figures =
                measure(document(one.model), options, given.files, given.assets);
            print(one.name, figures);
            INFO(one.name);
            REQUIRE(figures.interior.pixels > 3000);
            CHECK(figures.stray == 0);
            // As for the other textures: 8-bit filter weights on top of rounding, and triangles
            // with separate texture coordinates at poles.
            CHECK(figures.interior.rms < 0.55);
            CHECK(figures.interior.percentile999 < 3.0);
        }
}
