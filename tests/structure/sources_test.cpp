#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/paths.h"

/// The rules of docs/explanation/architecture.md that a compiler does not see.
namespace {
namespace fs = std::filesystem;

struct Source {
    std::string path;  ///< from the root, with forward slashes
    std::vector<std::string> lines;

    std::string folder() const { return path.substr(0, path.find('/')); }
    bool in(const std::string& place) const { return path.rfind(place, 0) == 0; }
};

struct Include {
    int line;
    std::string target;
};

std::vector<std::string> linesOf(std::istream& in) {
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// The floors from the ground up: a floor includes itself and those before it.
const std::vector<std::string> kFloors{"core",        "image", "scene",  "generator", "render",
                                       "interchange", "grade", "worker", "server",    "cli"};

std::vector<Source> sources() {
    std::vector<Source> all;
    std::vector<std::string> folders = kFloors;
    folders.push_back("tests");
    for (const std::string& folder : folders) {
        const fs::path root = fs::path(farol::test::kSourceDir) / folder;
        if (!fs::is_directory(root)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(root)) {
            const std::string ending = entry.path().extension().string();
            if (!entry.is_regular_file() || (ending != ".cpp" && ending != ".h")) continue;
            std::ifstream in(entry.path());
            all.push_back(
                {entry.path().lexically_relative(farol::test::kSourceDir).generic_string(),
                 linesOf(in)});
        }
    }
    return all;
}

/// Returns the path of an #include without its quotes or brackets.
std::vector<Include> includesOf(const Source& source) {
    std::vector<Include> all;
    for (std::size_t i = 0; i < source.lines.size(); ++i) {
        std::istringstream words(source.lines[i]);
        std::string hash, target;
        words >> hash;
        if (hash == "#") {
            words >> target;
            hash += target;
        }
        if (hash.rfind("#include", 0) != 0) continue;
        target = hash.size() > 8 ? hash.substr(8) : "";
        if (target.empty()) words >> target;
        if (target.size() < 2) continue;
        all.push_back({static_cast<int>(i) + 1, target.substr(1, target.size() - 2)});
    }
    return all;
}

std::string breach(const Source& source, const Include& include, const std::string& rule) {
    return source.path + ":" + std::to_string(include.line) + ": includes " + include.target +
           ": " + rule;
}

/// Returns the place of a floor in kFloors; kFloors.size() for other folders.
std::size_t heightOf(const std::string& folder) {
    return static_cast<std::size_t>(std::find(kFloors.begin(), kFloors.end(), folder) -
                                    kFloors.begin());
}

const std::set<std::string> kGeneratorDoor{"generator/registry.h", "generator/mesh.h"};

/// Plain data of render/ that its plan is made from.
const std::set<std::string> kPlanDoor{"render/options.h", "render/gl_facts.h"};

/// The one place where each third-party library is met.
struct Library {
    std::vector<std::string> headers;  ///< beginnings of what is included
    std::string place;                 ///< beginning of the paths that may
    std::size_t files;                 ///< how many sources may, 0: any number
};
const std::vector<Library> kLibraries{{{"GL/", "EGL/"}, "render/gl/", 0},
                                      {{"tiffio"}, "image/", 1},
                                      {{"OpenImageIO/"}, "image/oiio/", 1},
                                      {{"libav", "libsw"}, "image/video/", 1},
                                      {{"gif_lib"}, "image/", 2},
                                      {{"stb/stb_image.h"}, "image/", 1},
                                      {{"isa-l"}, "image/", 1},
                                      {{"jpeglib", "webp/", "turbojpeg"}, "image/", 3},
                                      {{"png.h"}, "image/", 1},
                                      {{"pugixml"}, "scene/", 0},
                                      {{"archive.h", "archive_entry.h"}, "scene/files/", 1},
                                      {{"blake2"}, "core/", 1},
                                      {{"seccomp.h"}, "worker/", 1},
                                      {{"httplib"}, "server/http/", 0},
                                      {{"hiredis/"}, "server/store/", 1},
                                      {{"CLI/"}, "cli/", 0},
                                      {{"catch2/"}, "tests/", 0}};

bool startsWithAny(const std::string& text, const std::vector<std::string>& beginnings) {
    return std::any_of(beginnings.begin(), beginnings.end(),
                       [&](const std::string& one) { return text.rfind(one, 0) == 0; });
}

std::vector<std::string> directionBreaches(const std::vector<Source>& all) {
    std::vector<std::string> found;
    for (const Source& source : all) {
        const std::size_t height = heightOf(source.folder());
        if (height == kFloors.size()) continue;
        for (const Include& include : includesOf(source)) {
            const std::string target = include.target.substr(0, include.target.find('/'));
            if (target == "tests" || target == "bench")
                found.push_back(breach(source, include, "the program stands without it"));
            if (heightOf(target) == kFloors.size()) continue;
            if (heightOf(target) > height)
                found.push_back(breach(source, include, "includes point downward"));
            if (source.folder() == "render" && target == "generator" &&
                kGeneratorDoor.count(include.target) == 0)
                found.push_back(
                    breach(source, include, "render sees the generator's registry and mesh only"));
            if (source.in("render/plan/") && target == "render" &&
                include.target.rfind("render/plan/", 0) != 0 &&
                kPlanDoor.count(include.target) == 0)
                found.push_back(breach(source, include, "the plan knows neither GL nor facade"));
        }
    }
    return found;
}

std::vector<std::string> libraryBreaches(const std::vector<Source>& all) {
    std::vector<std::string> found;
    for (const Library& library : kLibraries) {
        std::set<std::string> users;
        for (const Source& source : all)
            for (const Include& include : includesOf(source)) {
                if (!startsWithAny(include.target, library.headers)) continue;
                if (source.in("tests/")) continue;
                users.insert(source.path);
                if (!source.in(library.place))
                    found.push_back(breach(source, include, "is for " + library.place + " only"));
            }
        if (library.files != 0 && users.size() > library.files)
            found.push_back(library.headers.front() + " is met in " + std::to_string(users.size()) +
                            " files");
    }
    return found;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

}  // namespace

TEST_CASE("includes point the way the architecture says") {
    const std::vector<Source> all = sources();
    REQUIRE(all.size() > 50);
    const std::vector<std::string> found = directionBreaches(all);
    INFO(joined(found));
    CHECK(found.empty());
}

TEST_CASE("each third-party library is met in one place") {
    const std::vector<std::string> found = libraryBreaches(sources());
    INFO(joined(found));
    CHECK(found.empty());
}

TEST_CASE("a breach of either rule is found") {
    const std::vector<Source> bad{
        {"core/a.cpp", {"#include \"image/image.h\""}},
        {"image/b.cpp", {"#include \"scene/scene.h\""}},
        {"generator/c.cpp", {"#include \"render/options.h\""}},
        {"scene/read/d.h", {"#pragma once", "# include <server/serve.h>"}},
        {"worker/e.h", {"#include \"server/log.h\""}},
        {"render/f.cpp", {"#include \"generator/io/mesh_file.h\""}},
        {"render/plan/g.cpp", {"#include \"render/gl/api.h\""}},
        {"render/plan/h.h", {"#include \"render/renderer.h\""}},
        {"grade/h.cpp", {"#include \"tests/support/exact.h\""}},
        {"render/plan/i.cpp", {"#include <GL/osmesa.h>"}},
        {"scene/read/j.cpp", {"#include <archive.h>"}},
        {"render/k.cpp", {"#include <png.h>"}},
        {"cli/l.cpp", {"#include\"httplib.h\""}}};
    CHECK(directionBreaches(bad).size() == 9);
    CHECK(libraryBreaches(bad).size() == 4);
    const std::vector<Source> good{
        {"core/a.cpp", {"#include \"core/error.h\""}},
        {"render/f.cpp", {"#include \"generator/registry.h\"", "#include \"core/error.h\""}},
        {"render/plan/g.h", {"#include \"render/gl_facts.h\"", "#include \"render/plan/cost.h\""}},
        {"render/gl/i.cpp", {"#include <GL/osmesa.h>", "#include \"render/plan/plan.h\""}},
        {"tests/unit/m.cpp", {"#include \"render/gl/api.h\"", "#include <png.h>"}},
        {"cli/l.cpp", {"#include \"server/serve.h\""}}};
    CHECK(directionBreaches(good).empty());
    CHECK(libraryBreaches(good).empty());
}

TEST_CASE("no source is longer than 500 lines") {
    for (const Source& source : sources()) {
        INFO(source.path << " has " << source.lines.size() << " lines");
        CHECK(source.lines.size() <= 500);
    }
}

TEST_CASE("headers are included from the root") {
    for (const Source& source : sources()) {
        if (source.in("tests/")) continue;
        for (std::size_t i = 0; i < source.lines.size(); ++i) {
            if (source.lines[i].rfind("#include \"", 0) != 0) continue;
            const std::string target = source.lines[i].substr(10, source.lines[i].size() - 11);
            INFO(source.path << ":" << i + 1 << ": " << target);
            CHECK(fs::exists(fs::path(farol::test::kSourceDir) / target));
        }
    }
}
