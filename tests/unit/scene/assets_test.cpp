#include "scene/files/assets.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "core/digest.h"
#include "tests/support/paths.h"

using namespace farol;
using namespace farol::scene;
namespace fs = std::filesystem;

namespace {

/// A fresh folder with one outside beside it.
class Folders {
  public:
    Folders() {
        root_ = fs::path(farol::test::kTestOutput) / ("assets-" + std::to_string(getpid()));
        fs::remove_all(root_);
        fs::create_directories(root_ / "in" / "sub");
        fs::create_directories(root_ / "out");
        put("in/a.txt", "A");
        put("in/sub/b.txt", "B");
        put("out/secret.txt", "S");
    }
    ~Folders() { fs::remove_all(root_); }
    Folders(const Folders&) = delete;
    Folders& operator=(const Folders&) = delete;

    void put(const std::string& path, const std::string& text) const {
        std::ofstream(root_ / path) << text;
    }
    fs::path path(const std::string& below) const { return root_ / below; }
    std::string inside() const { return (root_ / "in").string(); }

  private:
    fs::path root_;
};

}  // namespace

TEST_CASE("paths that may be read") {
    for (const char* good : {"a", "a.txt", "sub/b.txt", "a b.txt", "..a", "a..", ".hidden",
                             "sub/..b", "caf\xC3\xA9.jpg", "ab:c"})
        CHECK(isSafePath(good));
    for (const std::string bad : {"", "/", "/etc/passwd", "..", "../a", "a/..", "a/../b", "a//b",
                                  "a/", "./a", "a/./b", "a\\b", "\\\\host\\a", "C:/a", "c:a", "."})
        CHECK_FALSE(isSafePath(bad));
    CHECK_FALSE(isSafePath(std::string("a\0b", 3)));
    CHECK_FALSE(isSafePath(std::string(2000, 'a')));
}

TEST_CASE("a bundle serves its files and no unsafe names") {
    const BundleAssets bundle(
        {{"a.txt", "A"}, {"sub/b.txt", "B"}, {"../c.txt", "C"}, {"/d.txt", "D"}});
    CHECK(bundle.list() == std::vector<std::string>{"a.txt", "sub/b.txt"});
    CHECK(bundle.has("a.txt"));
    CHECK_FALSE(bundle.has("../c.txt"));
    CHECK_FALSE(bundle.has("/d.txt"));
    CHECK(bundle.read("sub/b.txt") == std::optional<std::string>("B"));
    CHECK_FALSE(bundle.read("nothing"));
    const BundleAssets other(std::map<std::string, std::string>{{"x", "A"}});
    CHECK(bundle.version("a.txt") != bundle.version("sub/b.txt"));
    CHECK(bundle.version("a.txt") == other.version("x"));
    CHECK(bundle.version("nothing").empty());
}

TEST_CASE("digests are BLAKE2b") {
    // Values by another implementation (Python's hashlib, digest_size=16).
    CHECK(contentDigest("") == "cae66941d9efbd404e4d88758ea67670");
    CHECK(contentDigest("abc") == "cf4ab791c62b8d2b2109c90275287816");
    CHECK(contentDigest(std::string(128, 'x')) == "874acca82a22239ec64a3e70c3ae494e");
    CHECK(contentDigest(std::string(300, 'x')) == "c2f093e41879e412280bfcc0ed6533e4");
}

TEST_CASE("a folder serves what is below it") {
    const Folders folders;
    const FolderAssets assets(folders.inside());
    CHECK(assets.list() == std::vector<std::string>{"a.txt", "sub/b.txt"});
    CHECK(assets.read("sub/b.txt") == std::optional<std::string>("B"));
    CHECK_FALSE(assets.has("sub"));
    CHECK_FALSE(assets.read("sub"));
    CHECK_FALSE(assets.has("no.txt"));
    for (const std::string bad :
         {"../out/secret.txt", "sub/../../out/secret.txt", "/etc/passwd", "./a.txt", ""}) {
        INFO(bad);
        CHECK_FALSE(assets.has(bad));
        CHECK_FALSE(assets.read(bad));
        CHECK(assets.version(bad).empty());
    }
    CHECK_FALSE(assets.read(folders.path("out/secret.txt").string()));
    CHECK_FALSE(assets.read(std::string("a.txt\0x", 7)));
}

TEST_CASE("symbolic links do not lead out of the folder") {
    const Folders folders;
    fs::create_symlink(folders.path("out/secret.txt"), folders.path("in/link.txt"));
    fs::create_directory_symlink(folders.path("out"), folders.path("in/outside"));
    fs::create_symlink("../../out/secret.txt", folders.path("in/sub/up.txt"));
    fs::create_symlink("a.txt", folders.path("in/alias.txt"));
    fs::create_symlink("loop", folders.path("in/loop"));
    const FolderAssets assets(folders.inside());
    for (const char* bad : {"link.txt", "outside/secret.txt", "sub/up.txt", "loop"}) {
        INFO(bad);
        CHECK_FALSE(assets.has(bad));
        CHECK_FALSE(assets.read(bad));
    }
    CHECK(assets.read("alias.txt") == std::optional<std::string>("A"));
    CHECK(assets.list() == std::vector<std::string>{"a.txt", "alias.txt", "sub/b.txt"});
}

TEST_CASE("a folder whose name starts like the root is outside") {
    const Folders folders;
    fs::create_directories(folders.path("inner"));
    folders.put("inner/x.txt", "X");
    fs::create_symlink("../inner/x.txt", folders.path("in/x.txt"));
    CHECK_FALSE(FolderAssets(folders.inside()).has("x.txt"));
}

TEST_CASE("special files and missing roots are not found") {
    const Folders folders;
    REQUIRE(mkfifo(folders.path("in/pipe").c_str(), 0600) == 0);
    const FolderAssets assets(folders.inside());
    CHECK_FALSE(assets.has("pipe"));
    CHECK_FALSE(assets.read("pipe"));  // would block for ever if it were opened as a file
    const FolderAssets none(folders.path("nowhere").string());
    CHECK(none.list().empty());
    CHECK_FALSE(none.has("a.txt"));
}

TEST_CASE("a file's version changes with its content") {
    const Folders folders;
    const FolderAssets assets(folders.inside());
    const std::string before = assets.version("a.txt");
    CHECK(before == assets.version("a.txt"));
    folders.put("in/a.txt", "longer");
    CHECK(before != assets.version("a.txt"));
}

TEST_CASE("files too large are refused before memory is allocated") {
    const Folders folders;
    fs::resize_file(folders.path("in/a.txt"), Assets::kMaxFileBytes + 1);  // sparse
    const FolderAssets assets(folders.inside());
    try {
        assets.read("a.txt");
        FAIL("it was read");
    } catch (const Error& error) {
        CHECK(error.code() == "limit.file-bytes");
    }
}

TEST_CASE("entries that are no files are recognised, and links out of the folder left out") {
    const Folders folders;
    REQUIRE(mkfifo(folders.path("in/pipe.x").c_str(), 0600) == 0);
    fs::create_directories(folders.path("in/folder.x"));
    fs::create_symlink("nowhere", folders.path("in/dangling.x"));
    fs::create_symlink("sub", folders.path("in/linked.x"));
    fs::create_symlink("../out", folders.path("in/out.x"));
    fs::create_symlink("../out/secret.txt", folders.path("in/secret.x"));
    fs::create_symlink("a.txt", folders.path("in/alias.x"));
    const FolderAssets assets(folders.inside());
    std::string found;
    for (const auto& odd : assets.oddities(".x")) found += odd.path + " " + odd.what + "\n";
    CHECK(found ==
          "dangling.x is a link that leads nowhere\nfolder.x is a folder\nlinked.x is a folder\n"
          "pipe.x is a pipe\n");
    for (const char* none : {"alias.x", "a.txt", "out.x", "secret.x", "../out", "missing"})
        CHECK(assets.oddityOf(none) == "");
    CHECK(assets.size("a.txt") == std::optional<std::uint64_t>(1));
    CHECK_FALSE(assets.size("pipe.x"));
}

TEST_CASE("a file that cannot be opened for want of descriptors is not missing") {
    const Folders folders;
    const FolderAssets assets(folders.inside());
    rlimit before{};
    REQUIRE(getrlimit(RLIMIT_NOFILE, &before) == 0);
    rlimit none = before;
    none.rlim_cur = 0;
    REQUIRE(setrlimit(RLIMIT_NOFILE, &none) == 0);
    bool readThrew = false, listThrew = false;
    try {
        (void)assets.read("a.txt");
    } catch (const std::system_error&) {
        readThrew = true;
    }
    try {
        (void)assets.list();
    } catch (const std::system_error&) {
        listThrew = true;
    }
    REQUIRE(setrlimit(RLIMIT_NOFILE, &before) == 0);
    CHECK(readThrew);
    CHECK(listThrew);
    CHECK(assets.read("a.txt") == std::optional<std::string>("A"));
}

TEST_CASE("another folder under the same path has another identity") {
    const Folders folders;
    const std::string path = folders.inside();
    const auto before = folderIdentity(path);
    REQUIRE(before);
    CHECK(folderIdentity(path) == before);
    fs::rename(path, folders.path("moved"));
    CHECK_FALSE(folderIdentity(path));
    fs::create_directories(path);
    REQUIRE(folderIdentity(path));
    CHECK(folderIdentity(path) != before);
    CHECK(folderIdentity(folders.path("moved").string()) == before);
    CHECK_FALSE(folderIdentity(folders.path("out/secret.txt").string()));
}
