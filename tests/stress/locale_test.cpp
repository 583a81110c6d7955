#include <catch2/catch.hpp>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <locale>

#include "scene/assets.h"
#include "scene/reader.h"
#include "scene/writer.h"

// A locale with a decimal comma, made for the test: few systems have one installed.
using namespace farol;

namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "de_DE.UTF-8";

/// A folder that holds the locale; empty, said aloud, where it cannot be made.
std::string commaLocale() {
    const fs::path folder = fs::path(FAROL_TEST_OUTPUT) / "locale";
    fs::create_directories(folder);
    const std::string command =
        "localedef -i de_DE -f UTF-8 '" + (folder / kName).string() + "' > /dev/null 2>&1";
    if (std::system(command.c_str()) == 0) return folder.string();
    std::puts("skipped: localedef makes no de_DE.UTF-8 here (Debian: package locales)");
    return "";
}

std::string bytesOf(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("scenes are read and written alike under a locale with a decimal comma") {
    const std::string folder = commaLocale();
    if (folder.empty()) return;
    const scene::FolderAssets assets(std::string(FAROL_SOURCE_DIR) + "/scenes/primitives");
    const std::string xml = assets.read("scene.xml").value();
    const auto again = [&] { return scene::write(scene::read(xml, {}, assets).scene); };
    const std::string before = again();
    setenv("LOCPATH", folder.c_str(), 1);
    REQUIRE(std::setlocale(LC_ALL, kName) != nullptr);
    std::locale::global(std::locale(kName));
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
    const std::string folder = commaLocale();
    if (folder.empty()) return;
    const std::string out = std::string(FAROL_TEST_OUTPUT) + "/comma";
    const std::string scene = std::string(FAROL_SOURCE_DIR) + "/scenes/primitives/scene.xml";
    const auto run = [&](const std::string& environment, const std::string& words) {
        const std::string command =
            environment + " '" + FAROL_BINARY + "' " + words + " > /dev/null 2>&1";
        return std::system(command.c_str());
    };
    const auto both = [&](const std::string& words, const std::string& ending) {
        INFO(words);
        const std::string plain = out + "-c" + ending, comma = out + "-de" + ending;
        REQUIRE(run("LC_ALL=C", words + " '" + plain + "'") == 0);
        REQUIRE(run("LOCPATH='" + folder + "' LC_ALL=" + kName, words + " '" + comma + "'") == 0);
        REQUIRE(bytesOf(plain).size() > 100);
        CHECK(bytesOf(plain) == bytesOf(comma));
    };
    both("render --width 96 --height 64 --fov 40.5 --debug 1 '" + scene + "' -o", ".png");
    both("generate torus 1 0.25 8 5", ".3d");
    both("generate torus 1 0.25 8 5", ".obj");
}
