#include <catch2/catch.hpp>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <locale>

#include "scene/files/assets.h"
#include "scene/read/reader.h"
#include "scene/write/writer.h"
#include "tests/support/comma_locale.h"
#include "tests/support/paths.h"

using namespace farol;

namespace {

namespace fs = std::filesystem;

std::string bytesOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("scenes are read and written alike under a locale with a decimal comma") {
    const std::string folder = test::commaLocale();
    const scene::FolderAssets assets(std::string(farol::test::kSourceDir) + "/scenes/primitives");
    const std::string xml = assets.read("scene.xml").value();
    const auto again = [&] { return scene::write(scene::read(xml, {}, assets).scene); };
    const std::string before = again();
    setenv("LOCPATH", folder.c_str(), 1);
    REQUIRE(std::setlocale(LC_ALL, test::kCommaLocale) != nullptr);
    std::locale::global(std::locale(test::kCommaLocale));
    char text[16];
    std::snprintf(text, sizeof text, "%.1f", 1.5);
    const std::string after = again();
    std::locale::global(std::locale::classic());
    std::setlocale(LC_ALL, "C");
    unsetenv("LOCPATH");
    REQUIRE(std::string(text) == "1,5");  // the locale did take effect
    CHECK(before.find("0.") != std::string::npos);
    CHECK(after == before);
}

TEST_CASE("the program gives the same files under a locale with a decimal comma") {
    const std::string folder = test::commaLocale();
    const std::string out = std::string(farol::test::kTestOutput) + "/comma";
    const std::string scene = std::string(farol::test::kSourceDir) + "/scenes/primitives/scene.xml";
    const auto run = [&](const std::string& environment, const std::string& words) {
        const std::string command =
            environment + " '" + farol::test::kProgram + "' " + words + " > /dev/null 2>&1";
        return std::system(command.c_str());
    };
    const auto both = [&](const std::string& words, const std::string& ending) {
        INFO(words);
        const std::string plain = out + "-c" + ending, comma = out + "-de" + ending;
        REQUIRE(run("LC_ALL=C", words + " '" + plain + "'") == 0);
        REQUIRE(run("LOCPATH='" + folder + "' LC_ALL=" + test::kCommaLocale,
                    words + " '" + comma + "'") == 0);
        REQUIRE(bytesOf(plain).size() > 100);
        CHECK(bytesOf(plain) == bytesOf(comma));
    };
    both("render --width 96 --height 64 --fov 40.5 --debug 1 '" + scene + "' -o", ".png");
    both("generate torus 1 0.25 8 5", ".3d");
    both("generate torus 1 0.25 8 5", ".obj");
}
