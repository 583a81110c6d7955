// Bundles that come as zip or tar files.
#include "scene/files/archive.h"

#include <catch2/catch.hpp>
#include <cstdio>

#include "scene/files/assets.h"
#include "tests/support/archives.h"

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

std::string gzip(const std::string& bytes) {
    archive* out = archive_write_new();
    archive_write_set_format_raw(out);
    archive_write_add_filter_gzip(out);
    archive_write_set_bytes_in_last_block(out, 1);
    std::string packed(bytes.size() + 4096, '\0');
    std::size_t used = 0;
    archive_write_open_memory(out, packed.data(), packed.size(), &used);
    archive_entry* entry = archive_entry_new();
    archive_entry_set_filetype(entry, AE_IFREG);
    archive_write_header(out, entry);
    archive_write_data(out, bytes.data(), bytes.size());
    archive_entry_free(entry);
    archive_write_close(out);
    archive_write_free(out);
    packed.resize(used);
    return packed;
}

std::string inUtf16(const std::string& text) {
    std::string wide = "\xFF\xFE";
    for (const char c : text) (wide += c) += '\0';
    return wide;
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
        // The scene that the message proposes can be read.
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
    };
    for (const auto& row : table)
        for (const Packing packing : {Packing::zip, Packing::tar, Packing::tarGz}) {
            INFO(row.name << " " << static_cast<int>(packing));
            CHECK(codeOf(pack(packing, row.entries)) == row.code);
        }
}

TEST_CASE("a link in an archive is the file that it leads to, or is left out") {
    const Packed scene{"p/scene.xml", "<world/>"}, wood{"p/tex/wood.png", "w"};
    const struct {
        const char* path;
        const char* target;
        bool isFile;
    } table[] = {
        {"p/a.png", "tex/wood.png", true},
        {"p/maps/a.png", "../tex/./wood.png", true},
        {"p/a.png", "../p/tex/wood.png", true},
        {"p/a.png", "/etc/passwd", false},
        {"p/a.png", "../../tex/wood.png", false},
        {"p/a.png", "tex", false},  // a folder
        {"p/a.png", "a.png", false},
        {"p/a.png", "gone.png", false},
    };
    for (const auto& row : table)
        for (const Packing packing : {Packing::zip, Packing::tar, Packing::tarGz}) {
            INFO(row.path << " -> " << row.target << " " << static_cast<int>(packing));
            const ArchiveAssets files(std::make_shared<const std::string>(
                pack(packing, {{row.path, "", AE_IFLNK, row.target}, scene, wood})));
            const std::string path = std::string(row.path).substr(2);  // without the top folder
            CHECK(files.has(path) == row.isFile);
            CHECK(files.read(path) ==
                  (row.isFile ? std::optional<std::string>("w") : std::nullopt));
            REQUIRE(files.findings().size() == 1);
            CHECK(files.findings()[0].code == "bundle.link");
            CHECK(files.findings()[0].severity == Severity::info);
        }
    // A chain, and two names of one entry that are read in one pass.
    const ArchiveAssets chain(std::make_shared<const std::string>(
        pack(Packing::tarGz, {{"a", "", AE_IFLNK, "b"}, {"b", "", AE_IFLNK, "c"}, {"c", "x"}})));
    chain.prefetch({"a", "b", "c"});
    CHECK(chain.read("a") == "x");
    CHECK(chain.read("b") == "x");
    CHECK(chain.read("c") == "x");
    const ArchiveAssets ring(std::make_shared<const std::string>(
        pack(Packing::tar, {{"a", "", AE_IFLNK, "b"}, {"b", "", AE_IFLNK, "a"}, {"c", "x"}})));
    CHECK(ring.list() == std::vector<std::string>{"c"});
    // Only tar files have these. A hard link's target counts from the top.
    const ArchiveAssets hard(std::make_shared<const std::string>(
        pack(Packing::tar, {{"t/a", "x"}, {"u/b", "", AE_IFREG, "", "t/a"}, {"c", "y"}})));
    CHECK(hard.read("u/b") == "x");
    CHECK(readArchive(pack(Packing::tar, {scene, {"fifo", "", AE_IFIFO}, {"zero", "", AE_IFCHR}}))
              .files.size() == 1);
}

TEST_CASE("an encrypted file is refused where it is needed") {
    std::string zip = pack(Packing::zipStored, {{"scene.xml", "<world/>"}, {"a.png", "x"}});
    // The flag of the second file, in its local head and in the directory.
    zip[zip.rfind("PK\3\4") + 6] |= 1;
    zip[zip.rfind("PK\1\2") + 8] |= 1;
    const ArchiveAssets files(std::make_shared<const std::string>(zip));
    CHECK(files.read("scene.xml") == "<world/>");
    try {
        files.read("a.png");
        FAIL("an encrypted file was read");
    } catch (const Error& error) {
        CHECK(error.code() == "bundle.entry");
    }
}

TEST_CASE("archives are bounded before they are unpacked") {
    const Packed scene{"scene.xml", "<world><background texture='zeros.png'/></world>"};
    // 48 MiB of zeros in some kilobytes.
    const std::string zeros(std::size_t{48} << 20U, '\0');
    for (const Packing packing : {Packing::zip, Packing::tarGz}) {
        const std::string bomb = pack(packing, {scene, {"zeros.png", zeros}});
        CHECK(bomb.size() < 100'000);
        CHECK(codeOf(bomb) == "limit.bundle");
    }
    CHECK(codeOf(pack(Packing::tarGz, {{"__MACOSX/zeros", zeros}, scene})) == "limit.bundle");
    CHECK(codeOf(pack(Packing::zipStored, {scene, {"zeros.png", zeros}})) == "");
    CHECK(codeOf(pack(Packing::zipStored, {scene, {"zeros.png", zeros}, {"a/zeros.png", zeros}})) ==
          "limit.bundle");
    std::vector<Packed> folders{scene};
    for (std::size_t i = 0; i < Assets::kMaxListed; ++i)
        folders.push_back({std::to_string(i), "", AE_IFDIR});
    CHECK(codeOf(pack(Packing::tar, folders)) == "limit.bundle");
}

TEST_CASE("what no document names counts for nothing in a zip file") {
    const Packed scene{"scene.xml", "<world/>"};
    const std::string zeros(std::size_t{48} << 20U, '\0');
    CHECK(codeOf(pack(Packing::zip, {scene, {"video.mp4", zeros}, {"__MACOSX/x", zeros}})) == "");
    const ArchiveAssets archive(
        std::make_shared<std::string>(pack(Packing::zip, {scene, {"video.mp4", zeros}})));
    CHECK(archive.size("video.mp4") == zeros.size());
    CHECK_THROWS_AS(archive.read("video.mp4"), Error);
    CHECK(archive.read("scene.xml") == "<world/>");
}

TEST_CASE("of a whole project the files that its documents name are kept") {
    std::vector<Packed> files{
        {"p/scene.xml",
         "<world><model file=\"Hare.OBJ\" texture='my%20skin.png'/>"
         "<!-- generator patch own.patch 2 --><model file=bezier_comet_3.3d/></world>"},
        {"p/m/hare.obj", "mtllib hare.mtl\nv 0 0 0\n"},
        {"p/m/hare.mtl", "newmtl a\nmap_Kd -s 2 2 1 winter fur.png\n"},
        {"p/t/winter fur.png", "f"},
        {"p/t/my skin.png", "s"},
        {"p/own.patch", "1"},
        {"p/comet.patch", "1"},
        {"p/other.xml", "<world/>"},
        {"p/wide.png", "w"},
        {"p/wide.xml", inUtf16("<world><model texture=\"wide.png\"/></world>")}};
    for (int i = 0; i < 400; ++i)
        files.push_back({"p/build/o" + std::to_string(i) + ".o", "object"});
    for (const Packing packing : kAll) {
        const Bundle bundle = readArchive(pack(packing, files));
        CHECK(bundle.main == "scene.xml");
        std::string names;
        for (const auto& [path, content] : bundle.files) names += path + " ";
        CHECK(names ==
              "comet.patch m/hare.mtl m/hare.obj other.xml own.patch scene.xml t/my skin.png "
              "t/winter fur.png wide.png wide.xml ");
    }
}

TEST_CASE("archives in an archive are folders, two deep") {
    const std::string third = pack(Packing::zip, {{"deep.png", "3"}});
    const std::string second = pack(Packing::tarGz, {{"s/t.png", "2"}, {"third.zip", third}});
    const std::string first =
        pack(Packing::zip, {{"scene.xml", "<world/>"}, {"second.tgz", second}});
    const ArchiveAssets archive(
        std::make_shared<std::string>(pack(Packing::tar, {{"first.zip", first}, {"a.txt", "1"}})));
    CHECK(archive.list() == std::vector<std::string>{
                                "a.txt", "first.zip", "first.zip/scene.xml", "first.zip/second.tgz",
                                "first.zip/second.tgz/s/t.png", "first.zip/second.tgz/third.zip"});
    CHECK(archive.read("first.zip/second.tgz/s/t.png") == "2");
    REQUIRE(archive.findings().size() == 1);
    CHECK(archive.findings()[0].code == "bundle.closed");
    CHECK(mainOf(archive) == "first.zip/scene.xml");
    // One that is damaged is left closed; the rest is read.
    const ArchiveAssets damaged(std::make_shared<std::string>(
        pack(Packing::tar, {{"scene.xml", "<world/>"}, {"a.zip", first.substr(0, 60)}})));
    CHECK(damaged.read("scene.xml") == "<world/>");
    REQUIRE(damaged.findings().size() == 1);
    CHECK_THAT(damaged.findings()[0].message, Catch::Contains("a.zip"));
}

TEST_CASE("a name twice with equal bytes is one file") {
    for (const Packing packing : kAll) {
        const Bundle bundle = readArchive(
            pack(packing, {{"scene.xml", "<world/>"}, {"t.png", "same"}, {"t.png", "same"}}));
        CHECK(bundle.files.size() == 2);
        CHECK(codeOf(pack(packing,
                          {{"scene.xml", "<world/>"}, {"t.png", "same"}, {"t.png", "sane"}})) ==
              "bundle.path");
    }
}

TEST_CASE("7z files are read, and rar files that are damaged say what to send") {
    const Packed scene{"scene.xml", "<world/>"};
    const Bundle bundle = readArchive(pack(Packing::sevenZip, {scene, {"t/a.png", "a"}}));
    CHECK(bundle.files.at("t/a.png") == "a");
    CHECK(codeOf("Rar!\x1a\x07\x01") == "bundle.damaged");
    try {
        readArchive("Rar!\x1a\x07");
    } catch (const Error& error) {
        CHECK_THAT(error.what(), Catch::Contains("zip"));
    }
    // Entries before a file in a solid archive are unpacked to reach it: bounded, too.
    const std::string zeros(std::size_t{32} << 20U, '\0');
    CHECK(codeOf(pack(Packing::sevenZip, {{"a/zeros.mp4", zeros}, scene})) == "limit.bundle");
}

TEST_CASE("which of many documents is the scene") {
    const auto main = [](std::vector<Packed> files) {
        return readArchive(pack(Packing::tar, files)).main;
    };
    const std::string world = "<?xml version=\"1.0\"?>\n<!-- <project> -->\n<World>\n</World>";
    CHECK(main({{"pom.xml", "<project/>"}, {"a/test.xml", world}}) == "a/test.xml");
    CHECK(main({{"old/x/scene.xml", world}, {"new/scene.xml", world}, {"b.xml", world}}) ==
          "new/scene.xml");
    CHECK(codeOf(pack(Packing::tar, {{"a/scene.xml", world}, {"b/scene.xml", world}})) ==
          "bundle.which-scene");
}

TEST_CASE("an archive compressed twice is refused before it is unpacked") {
    const std::string once = pack(Packing::tarGz, {{"scene.xml", "<world/>"}});
    CHECK(codeOf(once).empty());
    CHECK(codeOf(gzip(once)) == "bundle.damaged");
    CHECK(codeOf(gzip(pack(Packing::zip, {{"scene.xml", "<world/>"}}))) == "bundle.damaged");
}

TEST_CASE("headers of a gzipped tar file count as unpacked bytes") {
    // Half a gigabyte of headers that name no entry: the same global header again and again.
    const std::string tar = pack(Packing::tar, {{"scene.xml", "<world/>"}});
    std::string head = tar.substr(0, 512);
    head[156] = 'g';  // the kind: a global header
    const std::string records = "11 a=bbbbb\n";
    head.replace(124, 12, std::string("00000000013\0", 12));  // its records' size, octal
    head.replace(148, 8, 8, ' ');
    unsigned sum = 0;
    for (const char c : head) sum += static_cast<unsigned char>(c);
    char octal[8];
    std::snprintf(octal, sizeof octal, "%06o", sum);
    head.replace(148, 7, std::string(octal, 7));
    const std::string global = head + records + std::string(512 - records.size(), '\0');
    std::string many;
    for (int i = 0; i < 16'384; ++i) many += global;
    const std::string bytes = gzip(many + tar);
    CHECK(bytes.size() < 200'000);
    CHECK_FALSE(codeOf(bytes).empty());
    CHECK(codeOf(gzip(global + tar)).empty());
}

TEST_CASE("a zip file's directory is counted before it is read") {
    // One short file, and a directory that names it over and over.
    const std::string zip = pack(Packing::zipStored, {{"scene.xml", "<world/>"}});
    const std::size_t directory = zip.find("PK\1\2"), end = zip.find("PK\5\6");
    REQUIRE(end != std::string::npos);
    const std::string record = zip.substr(directory, end - directory);
    std::string bytes = zip.substr(0, directory);
    for (std::size_t i = 0; i < 2 * Assets::kMaxListed + 1; ++i) bytes += record;
    CHECK(codeOf(bytes + zip.substr(end)) == "limit.bundle");
    // Nested archives that are stored have such records, too.
    CHECK(codeOf(pack(Packing::zipStored, {{"scene.xml", "<world/>"}, {"a.zip", zip}})).empty());
}

TEST_CASE("names in archives: long, in Latin-1, with many dots") {
    const Packed scene{"scene.xml", "<world/>"};
    std::string dots;
    for (int i = 0; i < 200'000; ++i) dots += "./";
    // Each of these was moved to its front once for every "./" before it.
    std::vector<Packed> entries{scene};
    for (int i = 0; i < 20; ++i) entries.push_back({dots + std::to_string(i) + ".png", "x"});
    CHECK(readArchive(pack(Packing::tar, entries)).files.size() == 21);
    CHECK(codeOf(pack(Packing::tar, {scene, {std::string(5000, 'n'), "x"}})) == "bundle.path");

    std::string tar = pack(Packing::tar, {{"etage.png", "x"}, scene});
    tar[0] = '\xE9';  // and the checksum of its head, octal
    unsigned sum = 8 * ' ';
    for (std::size_t i = 0; i < 512; ++i)
        sum += i < 148 || i >= 156 ? static_cast<unsigned char>(tar[i]) : 0U;
    char octal[8];
    std::snprintf(octal, sizeof octal, "%06o", sum);
    tar.replace(148, 7, std::string(octal, 7));
    CHECK(readArchive(tar).files.count("\xC3\xA9tage.png") == 1);
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
    CHECK(codeOf(tar) == "bundle.damaged");
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
