// The libraries that draw: OSMesa and EGL of one Mesa give the same bytes.
#include <dlfcn.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "run.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

namespace {

using namespace farol::test;
namespace fs = std::filesystem;

bool isInstalled(const char* library) { return dlopen(library, RTLD_LAZY | RTLD_LOCAL) != nullptr; }

void needBoth() {
    if (!isInstalled("libOSMesa.so.8")) skipMissing("libOSMesa.so.8 is not installed");
    if (!isInstalled("libEGL.so.1")) skipMissing("libEGL.so.1 is not installed");
}

std::string drawn(const std::string& scene, const std::string& options) {
    const Outcome found = run("render '" + scene + "' -o p.png " + options);
    INFO(options << "\n" << found.err);
    REQUIRE(found.status == 0);
    return readFile("p.png");
}

}  // namespace

TEST_CASE("OSMesa and EGL draw the example scenes byte for byte alike") {
    needBoth();
    freshFolder();
    std::size_t count = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(kSourceDir) / "scenes")) {
        const std::string scene = (entry.path() / "scene.xml").string();
        if (!fs::exists(scene)) continue;
        // Both share the shader cache: the second one compiles nothing.
        const std::string options = "--width 240 --height 180 --time 1 --gl ";
        const std::string egl = drawn(scene, options + "egl");
        INFO(scene);
        CHECK(drawn(scene, options + "osmesa") == egl);
        ++count;
    }
    CHECK(count > 10);
}

TEST_CASE("every setting of samples and every layer is the same by OSMesa and by EGL") {
    needBoth();
    freshFolder();
    const std::string scene = (fs::path(kSourceDir) / "scenes/house/scene.xml").string();
    for (const std::string option :
         {"--aa 1", "--aa 2", "--aa 8", "--aa 16", "--layer depth", "--layer normal", "--layer id",
          "--shading wireframe", "--shading points", "--debug 1"}) {
        INFO(option);
        const std::string options = "--width 120 --height 90 " + option + " --gl ";
        CHECK(drawn(scene, options + "egl") == drawn(scene, options + "osmesa"));
    }
}

TEST_CASE("the source that draws is part of the renderer's version") {
    needBoth();
    const auto rendererBy = [](const std::string& source) {
        const Outcome found = run("version --json --gl " + source);
        REQUIRE(found.status == 0);
        return nlohmann::json::parse(found.out).at("renderer").get<std::string>();
    };
    CHECK(rendererBy("osmesa") != rendererBy("egl"));
    CHECK(rendererBy("auto") == rendererBy("osmesa"));
}

TEST_CASE("a source that the machine lacks is named") {
    freshFolder();
    writeFile("scene.xml", kScene);
    const Outcome wrong = run("render scene.xml -o p.png --gl vulkan");
    CHECK(wrong.status == 2);
    CHECK_THAT(wrong.err, Catch::Contains("auto, osmesa, egl, egl:gpu"));
    if (fs::exists("/dev/dri")) skip("a machine with a GPU");
    const Outcome none = run("render scene.xml -o p.png --gl egl:gpu");
    CHECK(none.status == 3);
    CHECK_THAT(none.err, Catch::Contains("egl:gpu"));
}
