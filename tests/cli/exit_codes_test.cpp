#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "run.h"

/// The contract of the command line: what it answers, with which exit code, in which words.
namespace {

using namespace farol::test;

struct Case {
    std::string arguments;
    int status;
    std::vector<std::string> stderrHolds;  ///< empty: nothing may be printed
};

void check(const std::vector<Case>& cases) {
    for (const Case& one : cases) {
        INFO("farol " << one.arguments);
        const Outcome found = run(one.arguments);
        INFO("stdout: " << found.out << "stderr: " << found.err);
        CHECK(found.status == one.status);
        if (one.stderrHolds.empty()) CHECK(found.err.empty());
        for (const std::string& words : one.stderrHolds)
            CHECK_THAT(found.err, Catch::Contains(words));
    }
}

}  // namespace

TEST_CASE("what the command line gets wrong is exit code 2") {
    freshFolder();
    writeFile("scene.xml", kScene);
    writeFile("unknown.toml", "prot = 8080\n");
    writeFile("range.toml", "port = 99999\n");
    writeFile("section.toml", "[serve]\nport = 8080\n");
    writeFile("list.toml", "scenes = [\"a\", \"b\"]\n");
    writeFile("flag.toml", "trust-proxy = maybe\n");
    check({
        {"", 2, {"subcommand", "[usage]"}},
        {"paint", 2, {"paint", "expected one of render", "[usage]"}},
        {"rendr scene.xml", 2, {"did you mean \"render\""}},
        {"render", 2, {"SCENE is required"}},
        {"render scene.xml", 2, {"--output is required"}},
        {"render scene.xml -o", 2, {"--output"}},
        {"render scene.xml -o p.bmp", 2, {"p.bmp", ".png"}},
        {"render scene.xml -o p.png --wdith 3", 2, {"--wdith", "mean --width?", "[usage]"}},
        {"render scene.xml -o p.png --eye 1 2 3", 2, {"does not expect \"2\""}},
        {"render scene.xml -o p.png --near 5 --far 2.5", 2, {"expected more than near, 5"}},
        {"render scene.xml -o p.png --width 0", 2, {"width", "1 to 4096 px", "[option.range]"}},
        {"render scene.xml -o p.png --width 100000", 2, {"1 to 4096 px"}},
        {"render scene.xml -o p.png --width 12x", 2, {"12x"}},
        {"render scene.xml -o p.png --fov 0", 2, {"fov", "0.01 to 179"}},
        {"render scene.xml -o p.png --fov nan", 2, {"fov"}},
        {"render scene.xml -o p.png --eye 1,2", 2, {"eye", "x,y,z"}},
        {"render scene.xml -o p.png --shading toon", 2, {"toon", "gouraud"}},
        {"render scene.xml -o p.png --assets nowhere", 2, {"nowhere"}},
        {"render scene.xml -o - --json", 2, {}},
        {"generate", 2, {"generate SHAPE"}},
        {"generate sphere", 2, {"too few words"}},
        {"generate sphere 1 10 10", 2, {".3d"}},
        {"generate teapot 4 t.3d", 0, {}},
        {"generate patch 4 teapot.patch t.3d", 0, {}},
        {"generate box 2 1 -", 0, {}},
        {"generate box 2 1 - --json", 2, {}},
        {"health http://127.0.0.1:1", 1, {"nothing answers"}},
        {"generate sphere 1 10 10 s.stl", 2, {"s.stl", ".3d"}},
        {"generate spere 1 10 10 s.3d", 2, {"spere", "did you mean \"sphere\"", "[shape.unknown]"}},
        {"generate sphere -1 10 10 s.3d", 2, {"-1", "sphere", "[shape.argument]"}},
        {"generate sphere 1 2 10 s.3d", 2, {"SLICES", "3", "[shape.argument]"}},
        {"generate sphere 1 10 10 10 10 s.3d", 2, {"sphere"}},
        {"generate sphere one 10 10 s.3d", 2, {"one"}},
        {"generate sphere nan 10 10 s.3d", 2, {"nan"}},
        {"generate sphere 1 99999 99999 s.3d", 2, {"[limit.triangles]"}},
        {"generate --frob 1 sphere 1 2 3 s.3d", 2, {"--frob"}},
        {"generate sphere 1 10 10 s.3d --uv round", 2, {"round"}},
        {"serve --isolate all", 2, {"--isolate"}},
        {"compare a.png", 2, {"expected two images"}},
        {"compare a.png b.png --crop 5x5", 2, {"WxH+X+Y"}},
        {"compare a.png b.png --diff d.jpg", 2, {"d.jpg"}},
        {"serve --port 70000", 2, {"--port"}},
        {"serve --port 0 --scenes nowhere", 2, {"nowhere"}},
        {"serve --deadline nan", 2, {"--deadline", "nan"}},
        {"render scene.xml -o p.png --deadline -1", 2, {"--deadline", "-1"}},
        {"serve --wait -1", 2, {"--wait"}},
        {"serve --config nowhere.toml", 2, {"nowhere.toml"}},
        {"serve --config unknown.toml", 2, {"unknown.toml", "prot", "no such setting"}},
        {"serve --config range.toml", 2, {"range.toml", "port", "0 to 65535"}},
        {"serve --config section.toml", 2, {"section.toml", "sections"}},
        {"serve --config list.toml", 2, {"list.toml", "scenes", "one value"}},
        {"serve --config flag.toml", 2, {"flag.toml", "trust-proxy", "true or false"}},
        {"health --timeout inf", 2, {"--timeout"}},
        {"health not-a-url", 2, {"not-a-url"}},
        {"health https://127.0.0.1", 2, {"http://host:port"}},
    });
    CHECK_FALSE(exists("p.png"));
    CHECK_FALSE(exists("s.3d"));
}

TEST_CASE("what the input gets wrong is exit code 1") {
    freshFolder();
    writeFile("scene.xml", kScene);
    writeFile("empty.xml", "");
    writeFile("cut.xml", std::string(kScene).substr(0, 300));
    writeFile("page.xml", "<html><body/></html>");
    writeFile("ghost.xml",
              "<world><group><models>\n<model file=\"ghost.3d\"/></models></group></world>");
    writeFile("broken.3d", "1 2\n3 4\n\n0 1 2\n");
    writeFile("text.png", "not a picture");
    check({
        {"render nosuch.xml -o p.png", 1, {"nosuch.xml: error: ", "[asset.missing]"}},
        {"render empty.xml -o p.png", 1, {"empty.xml"}},
        {"render cut.xml -o p.png", 1, {"cut.xml:", "error: ", "[xml."}},
        {"render page.xml -o p.png", 1, {"page.xml:1:1: error: ", "[scene."}},
        {"render ghost.xml -o p.png", 1, {"ghost.xml:2:", "ghost.3d", "[asset.missing]"}},
        {"render broken.3d -o p.png", 1, {"broken.3d", "[mesh."}},
        {"render scene.xml -o p.png --width 4096 --height 4096 --aa 16 --deadline 0.001",
         1,
         {"scene.xml", "--deadline", "[limit.deadline]"}},
        {"validate nosuch.xml", 1, {"nosuch.xml"}},
        {"validate ghost.xml", 1, {"ghost.xml:2:", "ghost.3d"}},
        {"convert broken.3d b.obj", 1, {"broken.3d", "[mesh."}},
        {"convert nosuch.3d b.obj", 1, {"nosuch.3d"}},
        {"generate patch nosuch.patch 4 b.obj", 1, {"nosuch.patch"}},
        {"compare text.png text.png", 1, {"text.png", "[image.unreadable]"}},
        {"compare nosuch.png text.png", 1, {"nosuch.png"}},
        {"health http://127.0.0.1:1", 1, {"not ready"}},
    });
    CHECK_FALSE(exists("p.png"));
    CHECK_FALSE(exists("b.obj"));
}

TEST_CASE("what cannot be written is exit code 3, and leaves nothing behind") {
    freshFolder();
    writeFile("scene.xml", kScene);
    writeFile("folder.png/file", "");
    check({
        {"render scene.xml -o nowhere/p.png", 3, {"nowhere/p.png", "[output.unwritable]"}},
        {"render scene.xml -o folder.png", 3, {"folder.png", "[output.unwritable]"}},
        {"generate sphere 1 8 8 nowhere/s.3d", 3, {"nowhere/s.3d", "[output.unwritable]"}},
        {"render scene.xml -o /dev/full", 3, {"/dev/full", "[output.unwritable]"}},
    });
    CHECK_FALSE(exists("nowhere"));
}

TEST_CASE("help and version are exit code 0, on stdout") {
    freshFolder();
    for (const std::string arguments : {"--help", "--version", "version", "render --help",
                                        "generate --help", "serve --help", "health --help"}) {
        INFO(arguments);
        const Outcome found = run(arguments);
        CHECK(found.status == 0);
        CHECK(found.err.empty());
        CHECK_FALSE(found.out.empty());
    }
    const std::string help = run("render --help").out;
    for (const char* option : {"--width", "--eye", "--azimuth", "--shading", "--aa", "--time"})
        CHECK_THAT(help, Catch::Contains(option));
    const std::string shapes = run("generate --help").out;
    for (const char* shape : {"plane", "box", "sphere", "cone", "cylinder", "torus", "patch"})
        CHECK_THAT(shapes, Catch::Contains(shape));
}
