// Bundles that come as zip or tar files.
#include "scene/archive.h"

#include <catch2/catch.hpp>

#include "scene/assets.h"
#include "tests/archives.h"

using namespace farol;
using namespace farol::scene;
using namespace farol::test;

namespace {

std::string codeOf(const std::string& bytes) {
    try {
        readArchive(bytes);
    } catch (const Error& error) {
        return error.code();
    }
    return "";
}

constexpr Packing kAll[] = {Packing::zip, Packing::zipStored, Packing::tar, Packing::tarGz};

}  // namespace

TEST_CASE("the same bundle comes out of every kind of archive") {
    const std::string wood(100'000, 'w');
    for (const Packing packing : kAll) {
        const std::string bytes = pack(packing, {{"scene.xml", "<world/>"},
                                                 {"textures/wood.png", wood},
                                                 {"\xC3\xA9t\xC3\xA9.png", "p"},
                                                 {"empty.txt", ""}});
        INFO(static_cast<int>(packing));
        CHECK(isArchive(bytes));
        const Bundle bundle = readArchive(bytes);
        CHECK(bundle.main == "scene.xml");
        CHECK(bundle.files.size() == 4);
        CHECK(bundle.files.at("textures/wood.png") == wood);
        CHECK(bundle.files.count("\xC3\xA9t\xC3\xA9.png") == 1);
        CHECK(digestOf(bundle) ==
              digestOf(readArchive(pack(Packing::tar, {{"empty.txt", ""},
                                                       {"\xC3\xA9t\xC3\xA9.png", "p"},
                                                       {"textures/wood.png", wood},
                                                       {"scene.xml", "<world/>"}}))));
    }
    CHECK_FALSE(isArchive("<world/>"));
    CHECK_FALSE(isArchive(""));
}

TEST_CASE("the folder that holds everything goes, and what systems add") {
    const Bundle bundle = readArchive(pack(Packing::zip, {{"my scene", "", AE_IFDIR},
                                                          {"my scene/a/one.xml", "<world/>"},
                                                          {"my scene/a/t.png", "t"},
                                                          {"__MACOSX/my scene/._one.xml", "x"},
                                                          {"my scene/.DS_Store", "x"}}));
    CHECK(bundle.main == "one.xml");
    CHECK(bundle.files.size() == 2);
    const Bundle windows =
        readArchive(pack(Packing::tar, {{"s\\scene.xml", "<world/>"}, {"s\\t\\t.png", "t"}}));
    CHECK(windows.files.count("t/t.png") == 1);
}

TEST_CASE("which file is the scene") {
    const auto mainOfFiles = [](std::vector<Packed> files) {
        return readArchive(pack(Packing::tar, files)).main;
    };
    CHECK(mainOfFiles({{"scene.xml", "a"}, {"other.xml", "b"}}) == "scene.xml");
    CHECK(mainOfFiles({{"UPPER.XML", "a"}, {"t.png", "b"}}) == "UPPER.XML");
    CHECK(codeOf(pack(Packing::tar, {{"t.png", "b"}})) == "bundle.no-scene");
    try {
        readArchive(pack(Packing::tar, {{"hare.OBJ", "v 0 0 0"}, {"t.png", "b"}}));
        FAIL("a mesh was taken for a scene");
    } catch (const Error& error) {
        CHECK(error.code() == "bundle.no-scene");
        // What to do about it is a scene that can be read.
        const std::string message = error.what();
        const std::size_t start = message.find("<world>");
        const std::size_t end = message.find("</world>");
        REQUIRE(end != std::string::npos);
        CHECK(message.substr(start, end + 8 - start) ==
              "<world><group><models><model file=\"hare.OBJ\"/></models></group></world>");
    }
    try {
        readArchive(pack(Packing::tar, {{"a.xml", "a"}, {"b.xml", "b"}}));
        FAIL("two scenes were taken");
    } catch (const Error& error) {
        CHECK(error.code() == "bundle.which-scene");
        CHECK(std::string(error.what()).find("\"a.xml\", \"b.xml\"") != std::string::npos);
    }
}

TEST_CASE("hostile archives are refused, whatever they try") {
    const Packed scene{"scene.xml", "<world/>"};
    const struct {
        const char* name;
        std::vector<Packed> entries;
        const char* code;
    } table[] = {
        {"up", {scene, {"../evil.png", "x"}}, "bundle.path"},
        {"up within", {scene, {"a/../../evil.png", "x"}}, "bundle.path"},
        {"up by backslashes", {scene, {"..\\evil.png", "x"}}, "bundle.path"},
        {"absolute", {scene, {"/etc/passwd", "x"}}, "bundle.path"},
        {"drive", {scene, {"C:/evil.png", "x"}}, "bundle.path"},
        {"control characters", {scene, {"a\nb.png", "x"}}, "bundle.path"},
        {"twice", {scene, {"a.png", "x"}, {"a.png", "y"}}, "bundle.path"},
        {"twice by backslash", {scene, {"t/a.png", "x"}, {"t\\a.png", "y"}}, "bundle.path"},
        {"long name", {scene, {std::string(2000, 'n'), "x"}}, "bundle.path"},
        {"symbolic link", {scene, {"a.png", "", AE_IFLNK, "/etc/passwd"}}, "bundle.entry"},
    };
    for (const auto& row : table)
        for (const Packing packing : {Packing::zip, Packing::tar, Packing::tarGz}) {
            INFO(row.name << " " << static_cast<int>(packing));
            CHECK(codeOf(pack(packing, row.entries)) == row.code);
        }
    // Only tar files have these.
    CHECK(codeOf(pack(Packing::tar, {scene, {"a.png", "", AE_IFREG, "", "scene.xml"}})) ==
          "bundle.entry");
    CHECK(codeOf(pack(Packing::tar, {scene, {"fifo", "", AE_IFIFO}})) == "bundle.entry");
    CHECK(codeOf(pack(Packing::tar, {scene, {"device", "", AE_IFCHR}})) == "bundle.entry");
}

TEST_CASE("archives are bounded before they are unpacked") {
    const Packed scene{"scene.xml", "<world/>"};
    // 64 MiB of zeros in some kilobytes, as file, as clutter to be skipped, and as many files.
    const std::string zeros(std::size_t{48} << 20U, '\0');
    for (const Packing packing : {Packing::zip, Packing::tarGz}) {
        const std::string bomb = pack(packing, {scene, {"zeros.png", zeros}});
        CHECK(bomb.size() < 100'000);
        CHECK(codeOf(bomb) == "limit.bundle");
        CHECK(codeOf(pack(packing, {{"__MACOSX/zeros", zeros}, scene})) == "limit.bundle");
    }
    CHECK(codeOf(pack(Packing::zipStored, {scene, {"zeros.png", zeros}})) == "");
    CHECK(codeOf(pack(Packing::zipStored, {scene, {"1.png", zeros}, {"2.png", zeros}})) ==
          "limit.bundle");
    std::vector<Packed> many{scene};
    for (std::size_t i = 0; i < kMaxBundleFiles - 1; ++i)
        many.push_back({std::to_string(i) + ".png", "x"});
    CHECK(codeOf(pack(Packing::zip, many)) == "");
    many.push_back({"more.png", "x"});
    CHECK(codeOf(pack(Packing::zip, many)) == "limit.bundle");
    std::vector<Packed> folders{scene};
    for (int i = 0; i < 1100; ++i) folders.push_back({"d" + std::to_string(i), "", AE_IFDIR});
    CHECK(codeOf(pack(Packing::tar, folders)) == "limit.bundle");
}

TEST_CASE("a tar file that says it is huge is not believed") {
    std::string tar = pack(Packing::tar, {{"a.png", "x"}, {"scene.xml", "<world/>"}});
    tar.replace(124, 12, std::string("77777777777\0", 12));  // the size of the first entry, octal
    unsigned sum = 0;
    for (int i = 0; i < 512; ++i)
        sum += i >= 148 && i < 156 ? ' '
                                   : static_cast<unsigned char>(tar[static_cast<std::size_t>(i)]);
    char text[9];
    std::snprintf(text, sizeof text, "%06o", sum);
    tar.replace(148, 7, std::string(text, 7));
    CHECK(codeOf(tar) == "limit.bundle");
}

TEST_CASE("damaged archives end in an error") {
    for (const Packing packing : kAll) {
        const std::string whole =
            pack(packing, {{"scene.xml", "<world/>"}, {"a.png", std::string(5000, 'a')}});
        int refused = 0;
        for (std::size_t size = 0; size < whole.size(); size += 37) {
            const std::string code = codeOf(whole.substr(0, size));
            refused += code.empty() ? 0 : 1;
            if (!code.empty()) CHECK(code.starts_with("bundle."));
        }
        CHECK(refused > 0);
        for (std::size_t at = 0; at < whole.size(); at += 11) {
            std::string bent = whole;
            bent[at] = static_cast<char>(bent[at] ^ 0x55);
            const std::string code = codeOf(bent);
            if (!code.empty()) CHECK((code.starts_with("bundle.") || code == "limit.bundle"));
        }
    }
}
