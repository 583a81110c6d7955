// The rule by which files are found (docs/scene-language.md, "How a file is found").
#include "scene/files/locator.h"

#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <random>

#include "core/text.h"
#include "scene/files/archive.h"
#include "scene/files/spelling.h"
#include "tests/support/archives.h"
#include "tests/support/paths.h"

using namespace farol;
using namespace farol::scene;
namespace fs = std::filesystem;

namespace {

using Files = std::map<std::string, std::string>;

struct Outcome {
    std::string path;
    std::string codes;  ///< of the findings, with blanks between
};

Outcome find(const Assets& assets, const std::string& document, const std::string& wanted) {
    Diagnostics found;
    const Location where{document, 3, 4};
    Outcome out;
    out.path = locate(assets, wanted, where, found).value_or("");
    out.codes = joined(found, " ", [](const Diagnostic& one) { return one.code; });
    for (const Diagnostic& one : found) {
        CHECK(one.where == where);
        const bool isWarning = one.code == "asset.found-elsewhere" || one.code == "asset.ambiguous";
        CHECK(one.severity == (isWarning ? Severity::warning : Severity::info));
    }
    return out;
}

/// The tree as a folder on disk, for as long as it lives.
class OnDisk {
  public:
    explicit OnDisk(const Files& files)
        : root_(fs::path(farol::test::kTestOutput) / ("locator-" + std::to_string(getpid()))) {
        fs::remove_all(root_);
        fs::create_directories(root_);
        for (const auto& [path, bytes] : files) {
            fs::create_directories((root_ / path).parent_path());
            std::ofstream(root_ / path) << bytes;
        }
    }
    ~OnDisk() { fs::remove_all(root_); }
    OnDisk(const OnDisk&) = delete;
    OnDisk& operator=(const OnDisk&) = delete;
    std::string root() const { return root_.string(); }

  private:
    fs::path root_;
};

const std::string kNfc = "ma\xC3\xA7\xC3\xA3.png";  // as most keyboards write it
const std::string kNfd =
    "mac\xCC\xA7"
    "a\xCC\x83.png";                                // as macOS stores it
const std::string kDos = "ma\xC2\x87\xC3\x86.png";  // code page 850 read as Latin-1
const std::string kTwice = "ma\xC3\x83\xC2\xA7\xC3\x83\xC2\xA3.png";  // UTF-8 read as Latin-1

}  // namespace

TEST_CASE("each step of the rule finds its file, and says so") {
    struct Row {
        const char* what;
        std::string document, wanted;
        std::vector<std::string> files;  ///< each with other bytes
        std::string found, codes;
    };
    const Row rows[] = {
        {"as written", "s.xml", "a/x.png", {"a/x.png", "x.png"}, "a/x.png", ""},
        {"a dot", "s.xml", "./a/./x.png", {"a/x.png"}, "a/x.png", ""},
        {"backslashes", "s.xml", "a\\x.png", {"a/x.png", "x.png"}, "a/x.png", ""},
        {"beside the document first",
         "p2/s.xml",
         "x.3d",
         {"p1/x.3d", "p2/x.3d", "x.3d"},
         "p2/x.3d",
         ""},
        {"below the document's folder",
         "p/s.xml",
         "t/x.png",
         {"p/t/x.png", "t/x.png"},
         "p/t/x.png",
         ""},
        {"up and down inside",
         "w/f/s.xml",
         "../f/x.png",
         {"r/x.png", "w/f/x.png"},
         "w/f/x.png",
         ""},
        {"up inside", "w/f/s.xml", "../../x.png", {"w/x.png", "x.png"}, "x.png", ""},
        {"the nearest parent",
         "a/b/c/s.xml",
         "t/x.png",
         {"a/t/x.png", "t/x.png", "z/t/x.png"},
         "a/t/x.png",
         "asset.in-parent"},
        {"the top", "a/b/s.xml", "t/x.png", {"t/x.png", "z/t/x.png"}, "t/x.png", "asset.in-parent"},
        {"the longest end",
         "s/s.xml",
         "q/t/x.png",
         {"z/q/t/x.png", "y/t/x.png", "y/x.png"},
         "z/q/t/x.png",
         "asset.found-elsewhere"},
        {"a shorter end",
         "s/s.xml",
         "q/t/x.png",
         {"y/t/x.png", "w/x.png"},
         "y/t/x.png",
         "asset.found-elsewhere"},
        {"the name alone", "s.xml", "x.png", {"t/x.png"}, "t/x.png", "asset.found-elsewhere"},
        {"the name alone, above",
         "s.xml",
         "../x.png",
         {"t/x.png"},
         "t/x.png",
         "asset.found-elsewhere"},
        {"a Windows path",
         "s.xml",
         "C:\\Users\\me\\x.png",
         {"t/x.png"},
         "t/x.png",
         "asset.found-elsewhere"},
        {"an absolute path",
         "s.xml",
         "/home/me/t/x.png",
         {"t/x.png", "x.png"},
         "t/x.png",
         "asset.found-elsewhere"},
        {"a file URL", "s.xml", "file:///C:/me/x.png", {"x.png"}, "x.png", "asset.found-elsewhere"},
        {"of namesakes the one nearest to the document",
         "p2/s/s.xml",
         "x.png",
         {"p1/t/x.png", "p2/t/x.png"},
         "p2/t/x.png",
         "asset.found-elsewhere"},
        {"several", "s.xml", "x.png", {"a/x.png", "b/x.png"}, "", "asset.ambiguous"},
        {"several with the longest end",
         "s.xml",
         "q/t/x.png",
         {"a/t/x.png", "b/t/x.png", "x.png"},
         "",
         "asset.ambiguous"},
        {"another case", "s.xml", "Earth.JPG", {"earth.jpg"}, "earth.jpg", "asset.case"},
        {"another case of a folder",
         "s.xml",
         "Tex/x.png",
         {"tex/x.png"},
         "tex/x.png",
         "asset.found-elsewhere"},
        {"the same case wins, wherever it is",
         "s.xml",
         "X.png",
         {"x.png", "t/X.png"},
         "t/X.png",
         "asset.found-elsewhere"},
        {"another case elsewhere",
         "s.xml",
         "x.png",
         {"t/X.PNG"},
         "t/X.PNG",
         "asset.case asset.found-elsewhere"},
        {"accents in another case",
         "s.xml",
         "\xC3\x81gua.png",
         {"\xC3\xA1gua.png"},
         "\xC3\xA1gua.png",
         "asset.case"},
        {"decomposed on disk", "s.xml", kNfc, {kNfd}, kNfd, "asset.unicode"},
        {"decomposed in the scene", "s.xml", kNfd, {kNfc}, kNfc, "asset.unicode"},
        {"Hangul",
         "s.xml",
         "\xEA\xB0\x81.png",
         {"\xE1\x84\x80\xE1\x85\xA1\xE1\x86\xA8.png"},
         "\xE1\x84\x80\xE1\x85\xA1\xE1\x86\xA8.png",
         "asset.unicode"},
        {"an encoded blank",
         "s.xml",
         "my%20tex.png",
         {"my tex.png"},
         "my tex.png",
         "asset.percent"},
        {"an encoded accent", "s.xml", "ma%C3%A7%C3%A3.png", {kNfc}, kNfc, "asset.percent"},
        {"a percent sign that is one", "s.xml", "100%.png", {"100%.png"}, "100%.png", ""},
        {"a DOS code page", "s.xml", kNfc, {kDos}, kDos, "asset.code-page"},
        {"UTF-8 read as Latin-1", "s.xml", kNfc, {kTwice}, kTwice, "asset.code-page"},
        {"bytes that are no UTF-8",
         "s.xml",
         kNfc,
         {"ma\xE7\xE3.png"},
         "ma\xE7\xE3.png",
         "asset.code-page"},
        {"what systems add", "s.xml", "x.png", {"__MACOSX/x.png", ".git/x.png"}, "", ""},
        {"nothing", "s.xml", "no.png", {"x.png"}, "", ""},
        {"no name", "s.xml", "", {"x.png"}, "", ""},
        {"a folder", "s.xml", "a/", {"a/x.png"}, "", ""},
        {"up alone", "a/s.xml", "..", {"x.png"}, "", ""},
    };
    for (const Row& row : rows) {
        Files files{{row.document, "<world/>"}};
        for (const std::string& file : row.files) files[file] = "bytes of " + file;
        INFO(row.what);
        const Outcome out = find(BundleAssets(files), row.document, row.wanted);
        CHECK(out.path == row.found);
        CHECK(out.codes == row.codes);
    }
}

TEST_CASE("copies with equal bytes are one file; others are named") {
    const Files copies{
        {"a/x.png", "same"}, {"b/x.png", "same"}, {"c/y.png", "1"}, {"d/y.png", "2"}};
    CHECK(find(BundleAssets(copies), "s.xml", "x.png").path == "a/x.png");
    const OnDisk disk(copies);
    CHECK(find(FolderAssets(disk.root()), "s.xml", "x.png").path == "a/x.png");
    Diagnostics found;
    CHECK_FALSE(locate(BundleAssets(copies), "y.png", {"s.xml", 1, 1}, found));
    REQUIRE(found.size() == 1);
    CHECK_THAT(found[0].message, Catch::Contains("\"c/y.png\", \"d/y.png\""));
}

TEST_CASE("the document that is shown by another name looks from its own folder") {
    const BundleAssets files(Files{{"a/x.png", "1"}, {"b/x.png", "2"}});
    Diagnostics found;
    const DocumentPlace main{"/home/me/a/s.xml", "a/s.xml"};
    CHECK(locate(files, "x.png", {"/home/me/a/s.xml", 1, 1}, found, main) == "a/x.png");
    CHECK(locate(files, "x.png", {"b/part.xml", 1, 1}, found, main) == "b/x.png");
    CHECK(locate(files, "x.png", {}, found, main) == "a/x.png");
    CHECK(found.empty());
}

TEST_CASE("a path that leads out of the files says how they are widened") {
    const BundleAssets files(Files{{"a/x.png", "1"}});
    Locator locator(files);
    const Location where{"a/s.xml", 1, 1};
    for (const char* out : {"../../y.png", "/y.png", "D:\\y.png", "../../a/../y.png"}) {
        INFO(out);
        CHECK(locator.leadsOut(out, where));
        CHECK_THAT(locator.advice(out, where).text, Catch::Contains("--assets"));
    }
    for (const char* in : {"y.png", "../y.png", "b/../../y.png", ""}) {
        INFO(in);
        CHECK_FALSE(locator.leadsOut(in, where));
        CHECK_THAT(locator.advice(in, where).text, !Catch::Contains("--assets"));
    }
}

TEST_CASE("in random trees the order of the rule holds, in folders and archives alike") {
    std::mt19937 random(20260);
    const auto pick = [&](const std::vector<std::string>& all) {
        return all[random() % all.size()];
    };
    const std::vector<std::string> folders{"a", "b", "B", "tex"}, names{"x.png", "X.png", "y.3d"};
    const auto path = [&](std::size_t most) {
        std::string text;
        for (std::size_t i = random() % (most + 1); i > 0; --i) text += pick(folders) + "/";
        return text;
    };
    int elsewhere = 0, parents = 0, ambiguous = 0, cases = 0;
    for (int tree = 0; tree < 150; ++tree) {
        // At the top, so that no folder holds everything and is left out.
        Files files{{"scene.xml", "<world/>"}};
        for (int i = 0; i < 8; ++i) files[path(3) + pick(names)] = std::to_string(random() % 3);
        std::vector<farol::test::Packed> packed;
        for (const auto& [name, bytes] : files) packed.push_back({name, bytes});
        const OnDisk disk(files);
        const FolderAssets folder(disk.root());
        const ArchiveAssets zip(std::make_shared<const std::string>(
            farol::test::pack(farol::test::Packing::zip, packed)));
        REQUIRE(folder.list() == zip.list());
        for (int look = 0; look < 12; ++look) {
            const std::string from = path(3);
            const std::string wanted = pick({"", "", "../", "../../"}) + path(2) + pick(names);
            CAPTURE(tree, from, wanted);
            const Outcome found = find(zip, from + "s.xml", wanted);
            const Outcome onDisk = find(folder, from + "s.xml", wanted);
            CHECK(found.path == onDisk.path);
            CHECK(found.codes == onDisk.codes);
            // The rule once more, as plainly as can be: the first place that has the file.
            std::string folderOf = from, expected;
            for (;;) {
                const std::string full = fs::path(folderOf + wanted).lexically_normal().string();
                if (files.count(full) != 0) {
                    expected = full;
                    break;
                }
                if (folderOf.empty()) break;
                folderOf.pop_back();
                folderOf.erase(folderOf.rfind('/') + 1);
            }
            if (!expected.empty()) {
                CHECK(found.path == expected);
                CHECK(found.codes == (folderOf == from ? "" : "asset.in-parent"));
            } else if (!found.path.empty()) {
                const bool isExact = baseName(found.path) == baseName(wanted);
                // Another case only where no file has the exact name.
                const auto exact = std::count_if(files.begin(), files.end(), [&](const auto& one) {
                    return baseName(one.first) == baseName(wanted);
                });
                if (!isExact) CHECK(exact == 0);
                CHECK(lowerCase(baseName(found.path)) == lowerCase(baseName(wanted)));
                CHECK_FALSE(found.codes.empty());
            }
            elsewhere += found.codes == "asset.found-elsewhere" ? 1 : 0;
            parents += found.codes == "asset.in-parent" ? 1 : 0;
            ambiguous += found.codes == "asset.ambiguous" ? 1 : 0;
            cases += found.codes.find("asset.case") != std::string::npos ? 1 : 0;
        }
    }
    // Each branch was met.
    CHECK(elsewhere > 20);
    CHECK(parents > 20);
    CHECK(ambiguous > 20);
    CHECK(cases > 5);
}

TEST_CASE("spellings of names") {
    using namespace spelling;
    CHECK(decomposed(kNfc) == kNfd);
    CHECK(decomposed("\xE1\xBA\xAD") == "a\xCC\xA3\xCC\x82");  // two marks, U+1EAD
    CHECK(decomposed("\xFF") == "\xFF");
    CHECK(percentDecoded("a%2Fb%zz%") == "a/b%zz%");
    CHECK(percentDecoded("a%00b") == "a%00b");
    // Greek, Cyrillic and letters with a stroke have no decomposition to help.
    for (const auto& [large, small] :
         std::vector<std::pair<std::string, std::string>>{{"\xCE\x91", "\xCE\xB1"},
                                                          {"\xD0\x96", "\xD0\xB6"},
                                                          {"\xC5\x81", "\xC5\x82"},
                                                          {"\xC3\x98", "\xC3\xB8"},
                                                          {"\xC5\xBD", "\xC5\xBE"},
                                                          {"\xD0\x81", "\xD1\x91"}})
        CHECK(folded(large) == folded(small));
    CHECK(folded("\xC3\x97") != folded("\xC3\xB7"));  // times and division sign
    CHECK(otherReadings("plain.png").empty());
    const auto readings = otherReadings(kDos);
    CHECK(std::find(readings.begin(), readings.end(), kNfc) != readings.end());
}
