#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "grade/images/compare.h"
#include "image/image_file.h"
#include "run.h"

namespace {

using namespace farol::test;
using farol::image::Image;
using nlohmann::json;

Image picture(const std::string& name) { return farol::image::decodeImage(readFile(name), name); }

Image draw(const std::string& arguments) {
    const Outcome found = run("render " + arguments + " -o p.png");
    INFO("farol render " << arguments << "\n" << found.err);
    REQUIRE(found.status == 0);
    return picture("p.png");
}

int differing(const Image& a, const Image& b) {
    int count = 0;
    REQUIRE(a.pixels.size() == b.pixels.size());
    for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i] ? 1 : 0;
    return count;
}

const std::uint8_t* centreOf(const Image& image) {
    const int index = (image.height / 2) * image.width + image.width / 2;
    return &image.pixels[4 * static_cast<std::size_t>(index)];
}

}  // namespace

TEST_CASE("render draws the scene in its window's size") {
    freshFolder();
    writeFile("scene.xml", kScene);
    const Image image = draw("scene.xml");
    CHECK(image.width == 96);
    CHECK(image.height == 64);
    CHECK(centreOf(image)[0] > 150);
    CHECK(centreOf(image)[1] < 10);
    CHECK(image.pixels[0] == 0);  // the corner shows the background
}

TEST_CASE("every form of a flag is understood") {
    freshFolder();
    writeFile("scene.xml", kScene);
    const Image eye = draw("scene.xml --eye -1,2,3");
    CHECK(draw("scene.xml --eye=-1,2,3") == eye);
    CHECK(draw("--eye -1,2,3 scene.xml") == eye);
    CHECK(draw("scene.xml --eye ' -1, 2, 3'") == eye);
    const Image left = draw("scene.xml --azimuth -30 --axes 1");
    CHECK(draw("scene.xml --azimuth=-30 --axes=1") == left);
    CHECK(differing(draw("scene.xml --azimuth 30 --axes 1"), left) > 0);
    CHECK(draw("scene.xml --width 300 --height=20").width == 300);
    CHECK(centreOf(draw("scene.xml --background '#0000ff' --eye 0,0,50 --target 0,90,0"))[2] ==
          255);
    // Given twice, the last one counts, as a query's own options win over a preset's.
    CHECK(draw("scene.xml --width 30 --width 40").width == 40);
}

TEST_CASE("the output's name chooses the format, and --format wins") {
    freshFolder();
    writeFile("scene.xml", kScene);
    const auto beginning = [](const std::string& arguments, const std::string& name) {
        const Outcome found = run("render scene.xml -o " + arguments);
        INFO(arguments << ": " << found.err);
        REQUIRE(found.status == 0);
        return readFile(name).substr(0, 4);
    };
    CHECK(beginning("a.png", "a.png") == "\x89PNG");
    CHECK(beginning("a.JPG", "a.JPG").substr(0, 2) == "\xff\xd8");
    CHECK(beginning("a.jpeg", "a.jpeg").substr(0, 2) == "\xff\xd8");
    CHECK(beginning("a.webp", "a.webp") == "RIFF");
    CHECK(beginning("b.png --format webp", "b.png") == "RIFF");
    CHECK(beginning("c --format jpeg", "c").substr(0, 2) == "\xff\xd8");
    const Outcome piped = run("render scene.xml -o -");
    CHECK(piped.status == 0);
    CHECK(piped.err.empty());
    CHECK(piped.out == readFile("a.png"));
}

TEST_CASE("scenes come from stdin, and assets from --assets") {
    freshFolder();
    writeFile("scene.xml", kScene);
    const Outcome piped = run("render - -o p.png", kScene);
    INFO(piped.err);
    REQUIRE(piped.status == 0);
    CHECK(picture("p.png") == draw("scene.xml"));
    writeFile("in/scene.xml",
              "<world><group><models><model file=\"m.3d\"/></models></group></world>");
    REQUIRE(run("generate box 2 1 parts/m.3d").status == 3);  // there is no such folder yet
    writeFile("parts/m.3d", "");
    REQUIRE(run("generate box 2 1 parts/m.3d").status == 0);
    CHECK(run("render in/scene.xml -o q.png").status == 1);
    CHECK(run("render in/scene.xml -o q.png --assets parts").status == 0);
}

TEST_CASE("a folder is opened at its scene, and files are found above a scene by --assets") {
    freshFolder();
    writeFile("project/pom.xml", "<project/>");
    writeFile("project/a/b/test.xml",
              "<world><group><models><model file=\"../m/box.3d\"/></models></group></world>");
    writeFile("project/m/box.3d", "");
    REQUIRE(run("generate box 2 1 project/m/box.3d").status == 0);
    CHECK(run("render project -o p.png").status == 0);
    const Outcome inside = run("render project/a/b/test.xml --assets project -o q.png --json");
    CHECK(inside.status == 0);
    CHECK_THAT(inside.out, Catch::Contains("asset.in-parent"));
    CHECK(picture("p.png") == picture("q.png"));
    // Without the folder that holds both it is a guess, and the message says how to do better.
    const Outcome outside = run("render project/a/b/test.xml -o r.png");
    CHECK(outside.status == 0);
    CHECK_THAT(outside.err, Catch::Contains("--assets"));
    writeFile("empty/read.me", "");
    CHECK(run("render empty -o p.png").status == 1);
}

TEST_CASE("a mesh file alone is drawn") {
    freshFolder();
    for (const std::string name : {"m.3d", "m.obj", "m.ply", "m.3db"}) {
        INFO(name);
        REQUIRE(run("generate torus 2 0.5 32 16 " + name).status == 0);
        const Image image = draw(name);
        CHECK(differing(image, Image{image.width, image.height,
                                     std::vector<std::uint8_t>(image.pixels.size(), 0)}) >
              image.width * image.height);
    }
}

TEST_CASE("a written mesh reads back, in every format") {
    freshFolder();
    const Outcome made = run("generate cone 1 2 4 3 a.3d");
    CHECK(made.status == 0);
    CHECK_THAT(made.out, Catch::Contains("triangles"));
    for (const std::string through : {"b.obj", "b.ply", "b.3db", "b.3d"}) {
        INFO(through);
        CHECK(run("convert a.3d " + through).status == 0);
        CHECK(run("convert " + through + " c.3d").status == 0);
        CHECK(readFile("c.3d") == readFile("a.3d"));
    }
    CHECK(run("generate patch teapot.patch 4 t.3d").status == 0);  // built in
    CHECK(run("generate plane 1 3 u.3d --uv atlas").status == 0);
    CHECK(run("generate a.3d u.3d").status == 2);
}

TEST_CASE("an output appears whole, and keeps its mode") {
    freshFolder();
    writeFile("scene.xml", kScene);
    writeFile("p.png", "old");
    REQUIRE(run("render scene.xml --width 0 -o p.png").status == 2);
    CHECK(readFile("p.png") == "old");
    REQUIRE(run("render nosuch.xml -o p.png").status == 1);
    CHECK(readFile("p.png") == "old");
    REQUIRE(run("render scene.xml -o p.png").status == 0);
    CHECK(readFile("p.png").size() > 100);
}

TEST_CASE("warnings are printed, and with --strict they are errors") {
    freshFolder();
    std::string scene = kScene;
    scene.replace(scene.find("<window"), 7, "<widnow");
    writeFile("scene.xml", scene);
    const Outcome lax = run("render scene.xml -o p.png");
    INFO(lax.err);
    CHECK(lax.status == 0);
    CHECK_THAT(lax.err, Catch::StartsWith("scene.xml:2:3: warning: "));
    CHECK(exists("p.png"));
    CHECK(run("validate scene.xml").status == 0);
    CHECK(run("validate scene.xml --strict").status == 1);
    const Outcome strict = run("render scene.xml -o q.png --strict");
    CHECK(strict.status == 1);
    CHECK_THAT(strict.err, Catch::StartsWith("scene.xml:2:3: error: "));
    CHECK_FALSE(exists("q.png"));
}

TEST_CASE("a run prints at most 50 findings, and the same missing file once") {
    freshFolder();
    std::string models;
    for (int i = 0; i < 132; ++i) models += "<model file=\"ghost.3d\"/>\n";
    writeFile("ghosts.xml", "<world><group><models>" + models + "</models></group></world>");
    const Outcome ghosts = run("validate ghosts.xml");
    CHECK(ghosts.status == 1);
    CHECK_THAT(ghosts.err, Catch::Contains("(132 times) [asset.missing]"));
    CHECK(std::count(ghosts.err.begin(), ghosts.err.end(), '\n') < 5);
    const json same = json::parse(run("validate ghosts.xml --json").out);
    REQUIRE(same.at("diagnostics").size() == 1);
    CHECK(same.at("diagnostics")[0].at("count") == 132);
    CHECK(same.at("diagnosticsTotal") == 132);

    models.clear();
    for (int i = 0; i < 132; ++i)
        models += "<model file=\"ghost-" + std::to_string(i) + ".3d\"/>\n";
    writeFile("ghosts.xml", "<world><group><models>" + models + "</models></group></world>");
    const Outcome many = run("validate ghosts.xml");
    CHECK(std::count(many.err.begin(), many.err.end(), '\n') == 50);
    CHECK_THAT(many.err, Catch::Contains("83 more findings are not shown"));
    const json listed = json::parse(run("validate ghosts.xml --json").out);
    CHECK(listed.at("diagnostics").size() == 50);
    CHECK(listed.at("diagnosticsTotal") == 132);
    CHECK(listed.at("diagnostics").back().at("message") == "83 more findings are not shown");
}

TEST_CASE("all output is on stdout with --json, and none on stderr") {
    freshFolder();
    writeFile("scene.xml", kScene);
    writeFile("cut.xml", std::string(kScene).substr(0, 300));
    const auto told = [](const std::string& arguments, int status) {
        const Outcome found = run(arguments);
        INFO(arguments << "\n" << found.out << found.err);
        CHECK(found.status == status);
        CHECK(found.err.empty());
        const json all = json::parse(found.out);
        CHECK(all.at("status") == status);
        CHECK(all.at("diagnostics").is_array());
        return all;
    };
    const json facts = told("validate scene.xml --json", 0);
    CHECK(facts.at("width") == 96);
    CHECK(facts.at("camera").at("fov") == 60.0);
    CHECK(facts.at("counts").at("triangles") > 100);
    const json drawn = told("render scene.xml -o p.png --json", 0);
    CHECK(drawn.at("height") == 64);
    CHECK(drawn.at("stats").at("instances") == 1);
    const json fault = told("render cut.xml -o p.png --json", 1).at("diagnostics").at(0);
    CHECK(fault.at("file") == "cut.xml");
    CHECK(fault.at("line") > 0);
    CHECK(fault.at("severity") == "error");
    CHECK_FALSE(fault.at("code").get<std::string>().empty());
    CHECK(told("generate box 1 2 b.ply --json", 0).at("triangles") == 48);
    CHECK(told("generate box -1 b.ply --json", 2).at("diagnostics").size() == 1);
    CHECK(told("version --json", 0).at("version").is_string());
    CHECK(told("render --json", 2).at("diagnostics").size() == 1);
    const json same = told("compare p.png p.png --json", 0);
    CHECK(same.at("max") == 0);
    CHECK(same.at("psnr").is_null());
    CHECK(same.at("tolerant").at("within").at(0).at("share") == 1.0);
}

TEST_CASE("compare crops what is larger, and shows where pictures differ") {
    freshFolder();
    writeFile("scene.xml", kScene);
    REQUIRE(run("render scene.xml -o a.png").status == 0);
    REQUIRE(run("render scene.xml -o b.png --background 255,0,0").status == 0);
    REQUIRE(run("render scene.xml -o c.png --width 200 --height 200").status == 0);
    const Outcome found = run("compare a.png b.png --diff d.png");
    CHECK(found.status == 0);
    CHECK_THAT(found.out, Catch::Contains("255.0000"));
    const Image shown = picture("d.png");
    CHECK(shown.width == 96);
    CHECK(shown.pixels[0] == 255);
    CHECK(shown.pixels[1] == 0);
    CHECK(run("compare a.png c.png").status == 1);
    CHECK(run("compare a.png c.png --crop 96x64+10+20").status == 0);
    const Outcome masked = run("compare a.png c.png --crop 96x64+10+20 --mask 96x32+0+0 --json");
    CHECK(json::parse(masked.out).at("counted") == 0.5);
    CHECK(run("compare a.png c.png --crop 96x64+10+20 --mask 96x64+0+0").status == 1);
    CHECK(run("compare a.png b.png --mask-axes").status == 1);  // pure red is like an axis
    CHECK(run("compare a.png a.png --mask-axes --heat h.png").status == 0);
    CHECK(picture("h.png").pixels[0] == 0);
    CHECK(run("compare a.png c.png --crop 96x64+150+20").status == 1);
}

TEST_CASE("what a file says cannot reach the terminal") {
    freshFolder();
    writeFile(
        "evil.xml",
        "<world><group><models><model file=\"\x1b]0;title\x07.3d\"/></models></group></world>");
    const Outcome found = run("render evil.xml -o p.png");
    CHECK(found.status == 1);
    for (const char c : found.err) CHECK((c == '\n' || static_cast<unsigned char>(c) >= 0x20));
}

TEST_CASE("an animation is one file of frames, or numbered files") {
    freshFolder();
    std::string scene = kScene;
    scene.insert(scene.find("<models>"),
                 "<transform><rotate time=\"2\" x=\"0\" y=\"1\" z=\"0\"/></transform>");
    writeFile("scene.xml", scene);
    const Outcome one = run("render scene.xml -o loop.png --frames 3 --json");
    INFO(one.err);
    REQUIRE(one.status == 0);
    const json told = json::parse(one.out);
    CHECK(told.at("frames") == 3);
    CHECK(told.at("fps") == Approx(1.5));  // one turn in two seconds
    CHECK_THAT(readFile("loop.png"), Catch::Contains("acTL"));
    CHECK(picture("loop.png") == draw("scene.xml"));  // viewers without animation show time 0
    CHECK(run("render scene.xml -o loop.png --frames 0").status == 2);
    CHECK(run("render scene.xml -o loop.png --fps nan").status == 2);
}

TEST_CASE("with placeholders the image is written, and the exit code is that of the errors") {
    freshFolder();
    writeFile("missing.xml",
              "<world><group><models><model file=\"box_1.3d\"><texture file=\"gone.png\"/></model>"
              "</models></group></world>");
    CHECK(run("render missing.xml -o p.png --width 32 --height 32").status == 1);
    const auto size = [](const char* file) { return readFile(file).size(); };
    CHECK_FALSE(exists("p.png"));
    const Outcome drawn =
        run("render missing.xml -o p.png --width 32 --height 32 --missing placeholder");
    CHECK(drawn.status == 1);
    CHECK_THAT(drawn.err, Catch::Contains("gone.png") && Catch::Contains("asset.missing"));
    CHECK(size("p.png") > 100);
    CHECK(run("render missing.xml -o p.png --missing never").status == 2);
    // Nothing is wrong: 0, as ever.
    writeFile("scene.xml", kScene);
    CHECK(run("render scene.xml -o p.png --missing placeholder").status == 0);
}
