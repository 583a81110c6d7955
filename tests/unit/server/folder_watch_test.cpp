#include "server/folder_watch.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "server/scenes.h"
#include "tests/support/paths.h"

using namespace farol::server;
namespace fs = std::filesystem;

namespace {

class Folder {
  public:
    explicit Folder(const std::string& name) : path_(fs::path(farol::test::kTestOutput) / name) {
        fs::remove_all(path_);
        fs::create_directories(path_);
        path_ = fs::canonical(path_);
    }
    ~Folder() { fs::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::string path(const std::string& below = "") const { return (path_ / below).string(); }
    void write(const std::string& below, const std::string& bytes) const {
        fs::create_directories(fs::path(path(below)).parent_path());
        std::ofstream(path(below)) << bytes;
    }

  private:
    fs::path path_;
};

}  // namespace

TEST_CASE("a watched folder has another revision after each change below it, and no other") {
    const Folder folder("watch");
    folder.write("a/one.xml", "1");
    FolderWatch watch(folder.path());
    REQUIRE(watch.fault().empty());
    auto last = watch.revision();
    REQUIRE(last);
    const auto isNoticed = [&] { return std::exchange(last, watch.revision()) != last; };
    folder.write("a/one.xml", "2");
    CHECK(isNoticed());
    folder.write("b.xml", "new");
    CHECK(isNoticed());
    fs::rename(folder.path("b.xml"), folder.path("c.xml"));
    CHECK(isNoticed());
    fs::create_symlink("one.xml", folder.path("a/link.xml"));
    CHECK(isNoticed());
    fs::remove(folder.path("c.xml"));
    CHECK(isNoticed());
    // A folder made later, and what is in it, however deep.
    folder.write("x/y/z/one.xml", "1");
    CHECK(isNoticed());
    folder.write("x/y/z/one.xml", "2");
    CHECK(isNoticed());
    fs::rename(folder.path("x/y"), folder.path("moved"));
    CHECK(isNoticed());
    folder.write("moved/z/one.xml", "3");
    CHECK(isNoticed());
    fs::remove_all(folder.path("moved"));
    CHECK(isNoticed());
    // Time alone makes a new one each second: of many calls some are closer.
    int same = 0;
    for (int i = 0; i < 1000; ++i) same += isNoticed() ? 0 : 1;
    CHECK(same > 0);
}

TEST_CASE("where there is nothing to watch every request looks") {
    FolderWatch none("");
    CHECK_FALSE(none.revision());
    const Folder folder("watch-many");
    for (std::size_t i = 0; i <= FolderWatch::kMaxFolders; ++i)
        fs::create_directory(folder.path(std::to_string(i)));
    FolderWatch many(folder.path());
    CHECK_FALSE(many.revision());
    CHECK(many.fault().find("4096") != std::string::npos);
    // It works all the same.
    folder.write("7/scene.xml", "one");
    SceneFolder scenes(folder.path());
    const auto before = scenes.find("7");
    REQUIRE(before);
    CHECK_FALSE(scenes.watchFault().empty());
    folder.write("7/scene.xml", "two");
    CHECK(scenes.find("7")->version != before->version);
}

TEST_CASE("an edit of a scene shows at once, also while others ask for it") {
    const Folder folder("watch-scenes");
    folder.write("house/scene.xml", "0");
    folder.write("house/deep/wood.png", "0");
    const SceneFolder scenes(folder.path());
    std::atomic<bool> over{false};
    std::vector<std::thread> others;
    for (int i = 0; i < 3; ++i)
        others.emplace_back([&] {
            while (!over) (void)scenes.find("house");
        });
    int stale = 0;
    for (int i = 1; i <= 200; ++i) {
        const auto before = scenes.find("house");
        folder.write(i % 2 == 0 ? "house/scene.xml" : "house/deep/wood.png", std::to_string(i));
        const auto after = scenes.find("house");
        if (!before || !after || after->version == before->version) ++stale;
    }
    fs::remove(folder.path("house/scene.xml"));
    CHECK_FALSE(scenes.find("house"));
    over = true;
    for (std::thread& one : others) one.join();
    CHECK(stale == 0);
}
