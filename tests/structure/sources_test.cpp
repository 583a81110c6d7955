#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

/// The rules of docs/architecture.md that a compiler does not see.
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

const std::vector<std::string> kFolders{"scene", "generator", "render", "server",
                                        "grade", "cli",       "tests"};

std::vector<Source> sources() {
    std::vector<Source> all;
    for (const std::string& folder : kFolders) {
        const fs::path root = fs::path(FAROL_SOURCE_DIR) / folder;
        if (!fs::is_directory(root)) continue;
        for (const auto& entry : fs::recursive_directory_iterator(root)) {
            const std::string ending = entry.path().extension().string();
            if (!entry.is_regular_file() || (ending != ".cpp" && ending != ".h")) continue;
            std::ifstream in(entry.path());
            all.push_back(
                {entry.path().lexically_relative(FAROL_SOURCE_DIR).generic_string(), linesOf(in)});
        }
    }
    return all;
}

/// What follows #include, without its quotes or brackets.
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

/// Which folders the sources of each folder may include.
const std::map<std::string, std::set<std::string>> kMayInclude{
    {"scene", {"scene"}},
    {"generator", {"generator", "scene"}},
    {"render", {"render", "generator", "scene"}},
    {"grade", {"grade", "render", "scene"}},
    {"server", {"server", "grade", "render", "generator", "scene"}},
    {"cli", {"cli", "server", "grade", "render", "generator", "scene"}}};

const std::set<std::string> kGeneratorDoor{"generator/registry.h", "generator/mesh.h"};

/// The one place where each third-party library is met.
struct Library {
    std::vector<std::string> headers;  ///< beginnings of what is included
    std::string place;                 ///< beginning of the paths that may
    std::size_t files;                 ///< how many sources may, 0: any number
};
const std::vector<Library> kLibraries{{{"GL/", "EGL/"}, "render/gl/", 0},
                                      {{"OpenImageIO/"}, "render/", 1},
                                      {{"pugixml"}, "scene/", 0},
                                      {{"httplib"}, "server/http/", 0},
                                      {{"CLI/"}, "cli/", 0},
                                      {{"hiredis/"}, "server/store/", 1},
                                      {{"seccomp.h"}, "server/worker/", 1},
                                      {{"archive.h", "archive_entry.h"}, "scene/", 1},
                                      {{"isa-l"}, "render/", 1},
                                      {{"jpeglib", "webp/", "turbojpeg"}, "render/", 2},
                                      {{"png.h"}, "render/", 1},
                                      {{"catch2/"}, "tests/", 0}};

bool startsWithAny(const std::string& text, const std::vector<std::string>& beginnings) {
    return std::any_of(beginnings.begin(), beginnings.end(),
                       [&](const std::string& one) { return text.rfind(one, 0) == 0; });
}

std::vector<std::string> directionBreaches(const std::vector<Source>& all) {
    std::vector<std::string> found;
    for (const Source& source : all) {
        const auto rule = kMayInclude.find(source.folder());
        if (rule == kMayInclude.end()) continue;
        for (const Include& include : includesOf(source)) {
            const std::string target = include.target.substr(0, include.target.find('/'));
            if (kMayInclude.count(target) == 0) continue;
            if (rule->second.count(target) == 0)
                found.push_back(breach(source, include, "the direction is against the rule"));
            if (source.folder() == "render" && target == "generator" &&
                kGeneratorDoor.count(include.target) == 0)
                found.push_back(
                    breach(source, include, "render sees the generator's registry and mesh only"));
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
    const std::vector<Source> bad{{"generator/a.cpp", {"#include \"render/image.h\""}},
                                  {"scene/b.h", {"#pragma once", "# include <server/serve.h>"}},
                                  {"render/c.cpp", {"#include \"generator/io/mesh_file.h\""}},
                                  {"render/d.cpp", {"#include <GL/osmesa.h>"}},
                                  {"cli/e.cpp", {"#include\"httplib.h\""}}};
    CHECK(directionBreaches(bad).size() == 3);
    CHECK(libraryBreaches(bad).size() == 2);
    const std::vector<Source> good{{"render/c.cpp", {"#include \"generator/registry.h\""}},
                                   {"render/gl/d.cpp", {"#include <GL/osmesa.h>"}},
                                   {"cli/e.cpp", {"#include \"server/serve.h\""}}};
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
            CHECK(fs::exists(fs::path(FAROL_SOURCE_DIR) / target));
        }
    }
}
