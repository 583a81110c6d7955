// api/errors.md against the sources: every code has an entry, every entry has a code, and every
// example gives the code that it stands under.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include "core/text.h"
#include "tests/support/paths.h"
#include "tests/unit/scene/reading.h"

using namespace farol;
using namespace farol::scene::test;
namespace fs = std::filesystem;

namespace {

std::string readFile(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::set<std::string> matches(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    std::set<std::string> all;
    for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at)
        all.insert((*at)[1]);
    return all;
}

/// String literals that have the form of a code or of a message's id, "code/variant". Names of
/// files have it too: "scene.xml".
std::set<std::string> codesInSources() {
    std::set<std::string> all;
    for (const char* folder : {"core", "image", "scene", "generator", "render", "interchange",
                               "grade", "worker", "server", "cli"}) {
        const fs::path root = fs::path(farol::test::kSourceDir) / folder;
        if (!fs::is_directory(root)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(root)) {
            const std::string ending = entry.path().extension().string();
            if (ending != ".cpp" && ending != ".h") continue;
            all.merge(matches(
                readFile(entry.path()),
                "\"((?:xml|scene|asset|shape|mesh|image|limit|option|http|busy|worker|"
                "bundle|store|grade|assignment|rubric|output|service|check|convert|requirement)"
                "\\.[a-z]+(?:-[a-z]+)*|not-ready|internal|usage)(?:/[a-z-]+)?\""));
        }
    }
    for (const char* file : {"scene.xml", "image.png", "image.bmp"}) all.erase(file);
    return all;
}

const std::string& catalogue() {
    static const std::string text =
        readFile(fs::path(farol::test::kSourceDir) / "api" / "errors.md");
    return text;
}

}  // namespace

TEST_CASE("every code of the sources is in the catalogue, and no other") {
    const std::set<std::string> used = codesInSources();
    const std::set<std::string> told = matches(catalogue(), "\n### ([a-z.-]+)\n");
    REQUIRE(used.size() > 60);
    std::set<std::string> untold, unused;
    std::set_difference(used.begin(), used.end(), told.begin(), told.end(),
                        std::inserter(untold, untold.end()));
    std::set_difference(told.begin(), told.end(), used.begin(), used.end(),
                        std::inserter(unused, unused.end()));
    CHECK(farol::joined(untold, " ") == "");
    CHECK(farol::joined(unused, " ") == "");
}

TEST_CASE("the examples of the catalogue give their codes") {
    const std::regex entry("\n### ([a-z.-]+)\n\n[^\n]*\n\n```xml\n([^`]*)\n```");
    int examples = 0;
    for (std::sregex_iterator at(catalogue().begin(), catalogue().end(), entry), end; at != end;
         ++at) {
        ++examples;
        const Outcome outcome = tryRead((*at)[2]);
        INFO((*at)[1] << "\n" << outcome.text());
        CHECK(outcome.find((*at)[1]) != nullptr);
    }
    CHECK(examples >= 44);
}
