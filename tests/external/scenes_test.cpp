// Scenes of others: each reads as its author meant it, or is refused with the right code and line.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "scene/read/reader.h"
#include "scene/write/writer.h"
#include "tests/support/paths.h"
#include "tests/support/scene_equality.h"
#include "tests/support/skip.h"

using namespace farol;
using namespace farol::scene;
namespace fs = std::filesystem;

namespace {

const fs::path kData = fs::path(farol::test::kSourceDir) / ".." / "shared" / "data";

std::string readFile(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Scenes of courses and engines; the other folders hold what students got wrong and what broke us.
bool isHandedOut(const std::string& path) {
    const std::string folder = path.substr(0, path.find('/'));
    return folder == "course" || folder == "engine_2017" || folder == "granada";
}

void requireData() {
    if (!fs::is_directory(kData)) test::skip("no folder ../shared/data");
}

ReadResult readScene(const std::string& path) {
    ReadOptions options;
    options.name = fs::path(path).filename().string();
    return read(readFile(kData / path), options,
                FolderAssets((kData / path).parent_path().string()));
}

/// False where it is refused, by an Error with a code: nothing else may be thrown.
bool isRead(const std::string& path) {
    try {
        readScene(path);
        return true;
    } catch (const Error& error) {
        CHECK(!error.code().empty());
        return false;
    }
}

int countModels(const std::vector<Group>& groups) {
    int count = 0;
    for (const Group& group : groups)
        count += static_cast<int>(group.models.size()) + countModels(group.groups);
    return count;
}

}  // namespace

TEST_CASE("every external scene reads, or is refused for what its name says") {
    requireData();
    int read = 0, refused = 0, othersRead = 0, othersRefused = 0;
    for (const auto& entry : fs::recursive_directory_iterator(kData)) {
        if (entry.path().extension() != ".xml") continue;
        const std::string path = entry.path().lexically_relative(kData).generic_string();
        INFO(path);
        if (!isHandedOut(path)) {
            isRead(path) ? ++othersRead : ++othersRefused;
            continue;
        }
        if (entry.path().filename().string().rfind("invalid", 0) == 0) {
            CHECK_THROWS_AS(readScene(path), Error);
            ++refused;
            continue;
        }
        Scene scene;
        REQUIRE_NOTHROW(scene = readScene(path).scene);
        CHECK(countModels(scene.groups) > 0);
        CHECK(equal(scene, farol::scene::read(write(scene), {}, BundleAssets()).scene));
        ++read;
    }
    CHECK(read >= 20);
    CHECK(refused >= 3);
    WARN("of other people's documents " << othersRead << " are read, " << othersRefused
                                        << " refused");
}

TEST_CASE("invalid external scenes are refused with code and line") {
    requireData();
    struct Refused {
        std::string file, code;
        int line;
    };
    const Refused cases[] = {
        {"engine_2017/invalidGroup.xml", "scene.duplicate-transform", 10},
        {"engine_2017/invalidModels.xml", "scene.duplicate-models", 21},
        {"engine_2017/invalidTranslate.xml", "scene.unknown-attribute", 8},
    };
    for (const Refused& one : cases) {
        INFO(one.file);
        try {
            readScene(one.file);
            FAIL_CHECK("it was read");
        } catch (const Error& error) {
            CHECK(error.code() == one.code);
            CHECK(error.primary().where.line == one.line);
        }
    }
}

TEST_CASE("malformed external scenes are repaired with a warning at the right line") {
    requireData();
    const auto findings = [](const std::string& path) {
        std::string all;
        for (const Diagnostic& one : readScene(path).diagnostics)
            all += one.code + ":" + std::to_string(one.where.line) + " ";
        return all;
    };
    CHECK(findings("course/malformed_2022/test_2_3.xml") == "xml.stray-text:37 ");
    CHECK(findings("course/malformed_2022/test_3_1.xml") == "");
    CHECK(findings("course/malformed_2022/test_4_3.xml") == "xml.stray-text:1 xml.unquoted:64 ");
    CHECK(findings("course/phase_2/test_2_3.xml") == "xml.stray-text:37 ");
}

TEST_CASE("the external solar system is read as meant") {
    requireData();
    const Scene scene = readScene("engine_2017/solarSystem.xml").scene;
    CHECK(scene.dialect == Dialect::engine2017);
    REQUIRE(scene.groups.size() == 1);
    const Group& root = scene.groups[0];
    CHECK(std::get<Translate>(root.transforms.at(0)).offset == glm::dvec3(0, 0, 15));
    CHECK(root.lights.size() == 1);
    CHECK(root.groups.size() == 12);
    CHECK(countModels(scene.groups) == 15);
    const Material& sun = root.groups[0].models.at(0).material.value();
    CHECK(sun.emissive.rgb == glm::vec3(1.0F));
    CHECK(root.groups[0].models[0].texture->file == "demos/sun.jpg");
    CHECK(std::get<FollowCurve>(root.groups.at(11).transforms.at(0)).points.size() == 4);
    CHECK_FALSE(scene.camera);  // framed, as any scene without a camera
}
