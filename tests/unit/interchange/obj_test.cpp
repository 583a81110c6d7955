#include <catch2/catch.hpp>

#include "generator/io/mesh_file.h"
#include "generator/io/mtl.h"
#include "interchange/write.h"
#include "scene/animation.h"

using namespace farol;
using namespace farol::interchange;

namespace {

WrittenScene obj(const std::string& xml) {
    render::Job job;
    job.xml = xml;
    job.assets = std::make_shared<scene::BundleAssets>();
    job.options.timeS = 1.0;
    return writeObj(job, "my scene", kMaxModelBytes);
}

}  // namespace

TEST_CASE("an OBJ has all models in world coordinates at the moment") {
    const WrittenScene written = obj(R"(<world><lights><light type="directional" dirY="1"/></lights>
      <group><transform><translate x="10"/><rotate time="4" y="1"/><scale x="-1"/></transform>
        <models><model file="box_2_1.3d"><texture file="chess:2x2"/>
          <color><diffuse R="255" G="0" B="0"/></color></model></models></group>
      <group><models><model file="sphere_1_8_4.3d"/></models></group></world>)");
    Diagnostics findings;
    const generator::Mesh mesh = generator::io::decodeMesh(written.bytes, "x.obj", findings);
    CHECK(mesh.parts().size() == 2);
    glm::dvec3 low(1e9), high(-1e9);
    const std::size_t end = mesh.parts()[0].first + mesh.parts()[0].count;
    for (std::size_t i = mesh.parts()[0].first; i < end; ++i) {
        low = glm::min(low, mesh.place(mesh.indices()[i]));
        high = glm::max(high, mesh.place(mesh.indices()[i]));
    }
    CHECK(glm::distance(low, glm::dvec3(9, -1, -1)) < 1e-5);
    CHECK(glm::distance(high, glm::dvec3(11, 1, 1)) < 1e-5);
    // Mirrored faces are turned: all face outwards.
    double volume = 0.0;
    for (std::size_t i = mesh.parts()[0].first; i < end; i += 3) {
        const auto at = [&](std::size_t k) {
            return mesh.place(mesh.indices()[i + k]) - glm::dvec3(10, 0, 0);
        };
        volume += glm::dot(at(0), glm::cross(at(1), at(2))) / 6.0;
    }
    CHECK(volume == Approx(8.0).epsilon(1e-4));
    REQUIRE(written.beside.size() == 2);
    CHECK(written.beside[0].name == "my_scene.mtl");
    CHECK(written.beside[1].name == "my_scene-0.png");
    CHECK(generator::io::materialLibraries(written.bytes) ==
          std::vector<std::string>{"my_scene.mtl"});
    const auto materials =
        generator::io::parseMtl(written.beside[0].bytes, "my_scene.mtl", findings);
    REQUIRE(materials.size() == 2);
    CHECK(materials[0].material.diffuse.rgb == glm::vec3(1, 0, 0));
    REQUIRE(materials[0].texture);
    CHECK(materials[0].texture->file == "my_scene-0.png");
    CHECK(std::count_if(written.diagnostics.begin(), written.diagnostics.end(),
                        [](const Diagnostic& one) { return one.code.starts_with("convert."); }) ==
          2);  // lights, motion
}
