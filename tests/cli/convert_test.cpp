#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/run.h"

using namespace farol::test;
using nlohmann::json;

TEST_CASE("a scene is converted to glTF, OBJ and other dialects") {
    freshFolder();
    writeFile("scene.xml", kScene);
    const Outcome glb = run("convert scene.xml scene.glb --json");
    INFO(glb.out << glb.err);
    REQUIRE(glb.status == 0);
    CHECK(json::parse(glb.out)["bytes"] == readFile("scene.glb").size());
    CHECK(readFile("scene.glb").substr(0, 4) == "glTF");
    REQUIRE(run("convert scene.xml model.obj").status == 0);
    CHECK_THAT(readFile("model.obj"), Catch::StartsWith("mtllib model.mtl\n"));
    CHECK_THAT(readFile("model.mtl"), Catch::Contains("newmtl"));
    for (const char* form : {"course", "2017", "2020", "canonical"}) {
        REQUIRE(run(std::string("convert scene.xml other.xml --to ") + form).status == 0);
        REQUIRE(run("render other.xml -o other.png --width 32 --height 32").status == 0);
        REQUIRE(run("render scene.xml -o scene.png --width 32 --height 32").status == 0);
        CHECK(readFile("other.png") == readFile("scene.png"));
    }
}

TEST_CASE("features that a format lacks are listed") {
    freshFolder();
    writeFile(
        "scene.xml",
        R"(<world><background color="red"/><lights><light type="directional" dirY="1"/></lights>
      <group><models><model file="box_1.3d" twoSided="true"/></models></group></world>)");
    const Outcome glb = run("convert scene.xml scene.glb");
    CHECK(glb.status == 0);
    CHECK_THAT(glb.err, Catch::Contains("convert.left-out") && Catch::Contains("the background"));
    const Outcome course = run("convert scene.xml course.xml --to course");
    CHECK(course.status == 0);
    CHECK_THAT(course.err, Catch::Contains("the background") && Catch::Contains("back faces"));
}

TEST_CASE("a mesh file is converted to other mesh formats") {
    freshFolder();
    REQUIRE(run("generate torus 2 0.5 12 8 torus.obj").status == 0);
    for (const char* name : {"torus.3d", "torus.ply", "torus.3db", "torus.glb"}) {
        INFO(name);
        CHECK(run(std::string("convert torus.obj ") + name).status == 0);
        CHECK(exists(name));
    }
    REQUIRE(run("convert torus.3d back.obj").status == 0);
    CHECK(readFile("back.obj") == readFile("torus.obj"));
}

TEST_CASE("a file is not converted onto itself") {
    freshFolder();
    writeFile("scene.xml", kScene);
    const Outcome outcome = run("convert scene.xml ./scene.xml");
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.err, Catch::Contains("another name for OUT"));
    CHECK(readFile("scene.xml") == kScene);
}

TEST_CASE("a conversion does not write over a file that the scene reads") {
    freshFolder();
    REQUIRE(run("generate box 2 model.obj").status == 0);
    const std::string mesh = readFile("model.obj");
    writeFile("scene.xml", R"(<world><lights><light type="directional" dirY="1"/></lights><group>
        <models><model file="model.obj"/></models></group></world>)");
    for (const char* output : {"model.obj", "./model.obj"}) {
        const Outcome outcome = run(std::string("convert scene.xml ") + output);
        CHECK(outcome.status == 2);
        CHECK_THAT(outcome.err, Catch::Contains("\"model.obj\" is a file that the scene reads"));
        CHECK(readFile("model.obj") == mesh);
    }
    CHECK_FALSE(exists("model.mtl"));
    CHECK(run("convert scene.xml other.obj").status == 0);
    CHECK(run("convert scene.xml other.obj").status == 0);  // its own earlier output
}

TEST_CASE("wrong names and forms of a conversion are refused") {
    freshFolder();
    writeFile("scene.xml", kScene);
    for (const char* words :
         {"scene.xml scene.3d", "scene.xml scene.png", "scene.xml scene.glb --to 2017",
          "scene.xml out.xml --to 1999", "scene.xml"})
        CHECK(run(std::string("convert ") + words).status == 2);
    CHECK(run("convert gone.xml scene.glb").status == 1);
    CHECK(run("generate scene.obj x.3d").status == 2);
}
