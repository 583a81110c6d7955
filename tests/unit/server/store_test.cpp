// The stores of uploaded scenes, in memory and on disk, held to the same promises.
#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <thread>

#include "server/store/disk_store.h"
#include "server/store/memory_store.h"
#include "server/store/scene_file.h"
#include "tests/support/paths.h"
#include "worker/backend.h"

using namespace farol;
using namespace farol::server;
using namespace farol::server::store;
namespace fs = std::filesystem;

namespace {

scene::Bundle bundleOf(const std::string& text, std::size_t bytes = 0) {
    return {"scene.xml", {{"scene.xml", text}, {"t/a.png", std::string(bytes, 'x')}}};
}

class Folder {
  public:
    Folder() : path_(fs::path(farol::test::kTestOutput) / ("store-" + std::to_string(getpid()))) {
        fs::remove_all(path_);
    }
    ~Folder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    std::string path() const { return path_.string(); }
    std::size_t files(const std::string& below) const {
        const fs::directory_iterator all(path_ / below);
        return static_cast<std::size_t>(std::distance(begin(all), end(all)));
    }

  private:
    fs::path path_;
};

struct Kind {
    const char* name;
    std::function<std::unique_ptr<SceneStore>(StoreLimits)> make;
};

std::vector<std::string> logged;

std::unique_ptr<DiskStore> openDisk(const Folder& folder, StoreLimits limits = {}) {
    return std::make_unique<DiskStore>(folder.path(), limits,
                                       [](const std::string& line) { logged.push_back(line); });
}

void write(const fs::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

std::string read(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_CASE("what is put is found again, by the id of its content") {
    const Folder folder;
    const Kind kinds[] = {
        {"memory", [](StoreLimits limits) { return std::make_unique<MemoryStore>(limits); }},
        {"disk", [&](StoreLimits limits) { return openDisk(folder, limits); }}};
    for (const Kind& kind : kinds) {
        INFO(kind.name);
        const auto store = kind.make({});
        const scene::Bundle bundle = bundleOf("<world/>", 1000);
        const SceneStore::Put first = store->put(bundle, false);
        CHECK(first.created);
        CHECK(isStoredId(first.entry.id));
        CHECK(first.entry.id == idOf(bundle));
        CHECK(store->list().empty());
        const auto found = store->get(first.entry.id);
        REQUIRE(found);
        CHECK(found->bundle->files == bundle.files);
        CHECK(found->bundle->main == "scene.xml");
        CHECK(found->entry == first.entry);

        const SceneStore::Put again = store->put(bundle, true);
        CHECK_FALSE(again.created);
        CHECK(again.entry.id == first.entry.id);
        REQUIRE(store->list().size() == 1);
        CHECK(store->put(bundle, false).entry.listed);  // once listed, listed

        const SceneStore::Put other = store->put(bundleOf("<world>2</world>"), false);
        CHECK(other.entry.id != first.entry.id);
        CHECK(store->bytes() == first.entry.bytes + other.entry.bytes);
        CHECK(store->remove(first.entry.id));
        CHECK_FALSE(store->remove(first.entry.id));
        CHECK_FALSE(store->get(first.entry.id));
        CHECK(store->get(other.entry.id));
        CHECK_FALSE(store->get("~00000000000000000000000000000000"));
    }
}

TEST_CASE("a full store lets go of what nobody asked for the longest") {
    const Folder folder;
    const Kind kinds[] = {
        {"memory", [](StoreLimits limits) { return std::make_unique<MemoryStore>(limits); }},
        {"disk", [&](StoreLimits limits) { return openDisk(folder, limits); }}};
    for (const Kind& kind : kinds) {
        INFO(kind.name);
        StoreLimits limits;
        limits.bytes = 10'000;
        const auto store = kind.make(limits);
        const std::string a = store->put(bundleOf("a", 3000), true).entry.id;
        const std::string b = store->put(bundleOf("b", 3000), true).entry.id;
        const std::string c = store->put(bundleOf("c", 3000), true).entry.id;
        CHECK(store->get(a));
        const std::string d = store->put(bundleOf("d", 3000), true).entry.id;
        CHECK_FALSE(store->get(b));
        for (const std::string& id : {a, c, d}) CHECK(store->get(id));
        CHECK(store->bytes() <= limits.bytes);
        try {
            store->put(bundleOf("e", 10'000), false);
            FAIL("a scene larger than the store was taken");
        } catch (const Error& error) {
            CHECK(error.code() == "limit.store");
        }
        for (const std::string& id : {a, c, d}) CHECK(store->get(id));
    }
}

TEST_CASE("scenes expire, and live on when they are sent again") {
    Index index({1'000'000, 10, std::chrono::seconds(100)});
    const Time start = Time(std::chrono::seconds(1'000));
    index.put({"a", true, index.expiry(start), 10});
    CHECK(index.find("a", start + std::chrono::seconds(99)) != nullptr);
    CHECK(index.find("a", start + std::chrono::seconds(100)) == nullptr);
    CHECK(index.listed(start + std::chrono::seconds(100)).empty());
    CHECK(index.toEvict("", start + std::chrono::seconds(100)) == std::vector<std::string>{"a"});
    index.put({"a", true, index.expiry(start + std::chrono::seconds(50)), 10});
    CHECK(index.find("a", start + std::chrono::seconds(120)) != nullptr);
    CHECK(Index({1, 1, std::chrono::seconds(0)}).expiry(start) == Time::max());

    const Folder folder;
    StoreLimits limits;
    limits.expire = std::chrono::seconds(1);
    const auto disk = openDisk(folder, limits);
    const std::string id = disk->put(bundleOf("short-lived"), true).entry.id;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (disk->get(id) && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    CHECK_FALSE(disk->get(id));
    CHECK(disk->expire() == 1);
    CHECK(folder.files("scenes") == 0);
}

TEST_CASE("a store that is opened again has all that was put, and nothing else") {
    const Folder folder;
    std::string kept, listed;
    SceneStore::Put before;
    {
        const auto store = openDisk(folder);
        kept = store->put(bundleOf("kept", 5000), false).entry.id;
        before = store->put(bundleOf("listed", 10), true);
        const std::string gone = store->put(bundleOf("gone"), false).entry.id;
        store->remove(gone);
    }
    const auto store = openDisk(folder);
    CHECK(store->get(kept)->bundle->files.at("t/a.png").size() == 5000);
    REQUIRE(store->list().size() == 1);
    // The file tells whole seconds.
    CHECK(store->list()[0].expires <= before.entry.expires);
    CHECK(store->list()[0].expires + std::chrono::seconds(1) > before.entry.expires);
    CHECK(folder.files("scenes") == 2);
}

TEST_CASE("what is damaged or not ours is set aside with a word, and never served") {
    const Folder folder;
    std::vector<std::string> ids;
    for (const char* text : {"cut", "bent", "renamed", "whole", "empty"})
        ids.push_back(openDisk(folder)->put(bundleOf(text, 300), true).entry.id);
    const auto file = [&](std::size_t i) {
        return fs::path(folder.path()) / "scenes" / (ids[i].substr(1) + ".scene");
    };
    write(file(0), read(file(0)).substr(0, 200));
    std::string bent = read(file(1));
    bent[bent.size() / 2] ^= 1;
    write(file(1), bent);
    const fs::path elsewhere = file(2).parent_path() / "00000000000000000000000000000000.scene";
    fs::rename(file(2), elsewhere);
    write(file(4), "");
    write(file(0).parent_path() / "notes.txt", "alien");
    fs::create_directories(file(0).parent_path() / "a-folder");
    fs::create_symlink("/etc/passwd", file(0).parent_path() / "link.scene");
    write(fs::path(folder.path()) / "new" / "half.scene", "half written");

    logged.clear();
    const auto store = openDisk(folder);
    CHECK(logged.size() == 8);  // seven set aside, and how many there are
    for (const std::size_t i : {0U, 1U, 2U, 4U}) CHECK_FALSE(store->get(ids[i]));
    CHECK_FALSE(store->get("~00000000000000000000000000000000"));
    CHECK(store->get(ids[3]));
    CHECK(store->list().size() == 1);
    CHECK(folder.files("scenes") == 1);
    CHECK(folder.files("aside") == 7);
    CHECK(folder.files("new") == 0);
    CHECK(read("/etc/passwd").size() > 0);
}

TEST_CASE("what is damaged while the store is open is not served either") {
    const Folder folder;
    const auto store = openDisk(folder);
    const std::string id = store->put(bundleOf("fine", 300), true).entry.id;
    const fs::path file = fs::path(folder.path()) / "scenes" / (id.substr(1) + ".scene");
    write(file, read(file).substr(0, 100));
    CHECK_FALSE(store->get(id));
    CHECK_FALSE(store->get(id));
    CHECK(store->list().empty());
    CHECK(folder.files("aside") == 1);
    CHECK(store->put(bundleOf("fine", 300), true).created);
    CHECK(store->get(id));
}

namespace {

/// While it lives, no descriptor from `first` on can be opened (EMFILE).
class DescriptorLimit {
  public:
    explicit DescriptorLimit(int first) {
        REQUIRE(getrlimit(RLIMIT_NOFILE, &before_) == 0);
        rlimit limit = before_;
        limit.rlim_cur = static_cast<rlim_t>(first);
        REQUIRE(setrlimit(RLIMIT_NOFILE, &limit) == 0);
    }
    ~DescriptorLimit() { setrlimit(RLIMIT_NOFILE, &before_); }
    DescriptorLimit(const DescriptorLimit&) = delete;
    DescriptorLimit& operator=(const DescriptorLimit&) = delete;

  private:
    rlimit before_{};
};

/// The descriptor that is opened next after `count` others.
int descriptorAfter(int count) {
    std::vector<int> opened;
    for (int i = 0; i <= count; ++i) opened.push_back(open("/dev/null", O_RDONLY | O_CLOEXEC));
    for (const int fd : opened) close(fd);
    return opened.back();
}

template <typename Call>
std::string busyCodeOf(const Call& call) {
    try {
        call();
    } catch (const worker::Busy& busy) {
        CHECK(busy.retryAfterS() > 0);
        return busy.code();
    }
    return "none";
}

}  // namespace

TEST_CASE("a store without descriptors is busy, and changes nothing") {
    const Folder folder;
    std::string id;
    {
        const auto store = openDisk(folder);
        id = store->put(bundleOf("kept", 300), true).entry.id;
    }
    const auto store = openDisk(folder);  // nothing is in its memory now
    {
        const DescriptorLimit none(0);
        CHECK(busyCodeOf([&] { store->get(id); }) == "store.failed");
        CHECK(busyCodeOf([&] { store->put(bundleOf("new"), true); }) == "store.failed");
        CHECK(busyCodeOf([&] { store->put(bundleOf("kept", 300), true); }) == "store.failed");
        CHECK(busyCodeOf([&] { store->remove(id); }) == "store.failed");
        CHECK(store->list().size() == 1);
    }
    CHECK(store->get(id));
    CHECK(folder.files("aside") == 0);
    CHECK(folder.files("scenes") == 1);
    CHECK(folder.files("new") == 0);
}

TEST_CASE("a file that cannot be read when the store is opened stays, and is read later") {
    const Folder folder;
    const auto stored = [&](const char* text) {
        return openDisk(folder)->put(bundleOf(text, 300), true).entry.id;
    };
    const std::string read = stored("read"), sent = stored("sent"), swept = stored("swept"),
                      gone = stored("gone");
    std::unique_ptr<DiskStore> store;
    {
        // Enough for the lock and the folder, not for a file.
        const DescriptorLimit few(descriptorAfter(2));
        store = openDisk(folder);
        const DescriptorLimit none(0);
        CHECK(busyCodeOf([&] { store->get(read); }) == "store.failed");
        // Sent again while the file cannot be read: whether it is listed is not known.
        CHECK(busyCodeOf([&] { store->put(bundleOf("sent", 300), false); }) == "store.failed");
        store->expire();
    }
    CHECK(folder.files("scenes") == 4);
    CHECK(folder.files("aside") == 0);
    CHECK(store->get(read));
    const SceneStore::Put again = store->put(bundleOf("sent", 300), false);
    CHECK_FALSE(again.created);
    CHECK(again.entry.listed);
    CHECK(store->remove(gone));
    CHECK(store->list().size() == 2);
    store->expire();
    CHECK(store->list().size() == 3);
    CHECK(store->get(swept));
    CHECK(folder.files("aside") == 0);
}

TEST_CASE("a disk that is away is busy; a file that was removed is not there") {
    const Folder folder;
    std::vector<std::string> ids;
    for (const char* text : {"removed", "away"})
        ids.push_back(openDisk(folder)->put(bundleOf(text, 300), true).entry.id);
    const auto store = openDisk(folder);
    const fs::path scenes = fs::path(folder.path()) / "scenes";
    fs::remove(scenes / (ids[0].substr(1) + ".scene"));
    CHECK_FALSE(store->get(ids[0]));
    fs::rename(scenes, fs::path(folder.path()) / "elsewhere");
    CHECK(busyCodeOf([&] { store->get(ids[1]); }) == "store.failed");
    fs::rename(fs::path(folder.path()) / "elsewhere", scenes);
    CHECK(store->get(ids[1]));
}

TEST_CASE("what was set aside before is never written over") {
    const Folder folder;
    const std::string id = openDisk(folder)->put(bundleOf("fine", 300), true).entry.id;
    const std::string name = id.substr(1) + ".scene";
    const fs::path aside = fs::path(folder.path()) / "aside";
    write(aside / name, "earlier");
    for (int i = 1; i < 1000; ++i) write(aside / (name + "." + std::to_string(i)), "earlier");
    write(fs::path(folder.path()) / "scenes" / name, "damaged");
    const auto store = openDisk(folder);
    CHECK_FALSE(store->get(id));
    CHECK(folder.files("aside") == 1000);
    for (const auto& file : fs::directory_iterator(aside)) REQUIRE(read(file.path()) == "earlier");
    CHECK(store->put(bundleOf("fine", 300), true).created);
    CHECK(store->get(id));
}

TEST_CASE("a folder has one server") {
    const Folder folder;
    const auto first = openDisk(folder);
    CHECK_THROWS_AS(openDisk(folder), std::runtime_error);
}

TEST_CASE("a store that cannot write says so, and keeps nothing of it") {
    const Folder folder;
    const auto store = openDisk(folder);
    const std::string id = store->put(bundleOf("before"), true).entry.id;
    fs::remove_all(fs::path(folder.path()) / "new");
    std::string code;
    try {
        store->put(bundleOf("after"), true);
    } catch (const worker::Busy& busy) {
        code = busy.code();
    }
    CHECK(code == "store.failed");
    CHECK(store->list().size() == 1);
    CHECK(store->get(id));
    CHECK(folder.files("scenes") == 1);
}

TEST_CASE("no cut and no flipped bit of a file passes for a scene") {
    Stored scene;
    scene.entry.listed = true;
    scene.entry.expires = Time(std::chrono::seconds(1'000));
    scene.bundle = std::make_shared<const scene::Bundle>(bundleOf("<world/>", 40));
    const std::string file = encodeScene(scene);
    const auto whole = decodeScene(file);
    REQUIRE(whole);
    CHECK(whole->entry.id == idOf(*scene.bundle));
    CHECK(whole->entry.listed);
    CHECK(whole->entry.expires == scene.entry.expires);
    for (std::size_t size = 0; size < file.size(); ++size)
        CHECK_FALSE(decodeScene(file.substr(0, size)));
    for (std::size_t at = 0; at < file.size(); ++at) {
        std::string bent = file;
        bent[at] = static_cast<char>(bent[at] ^ 4);
        CHECK_FALSE(decodeScene(bent));
    }
    CHECK_FALSE(decodeScene(file + "x"));
}

TEST_CASE("many threads share a store") {
    const Folder folder;
    StoreLimits limits;
    limits.bytes = 20'000;
    const auto store = openDisk(folder, limits);
    std::atomic<int> wrong{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            for (int i = 0; i < 30; ++i) {
                const std::string text = std::to_string((t + i) % 12);
                const std::string id = store->put(bundleOf(text, 2000), i % 2 == 0).entry.id;
                const auto found = store->get(id);
                if (found && found->bundle->files.at("scene.xml") != text) ++wrong;
                if (i % 7 == 0) store->remove(id);
                store->list();
            }
        });
    for (std::thread& thread : threads) thread.join();
    CHECK(wrong == 0);
    CHECK(store->bytes() <= limits.bytes);
    CHECK(folder.files("aside") == 0);
    CHECK(folder.files("new") == 0);
}

namespace {

scene::Bundle numbered(int i) {
    return bundleOf(std::to_string(i), static_cast<std::size_t>(i * 7919 % 200'000));
}

/// Puts scenes until it is killed; tells of each that was acknowledged, by its number.
[[noreturn]] void putForever(const std::string& folder, int first, int out) {
    const auto ignore = [](const std::string&) {};
    const auto store = std::make_unique<DiskStore>(folder, StoreLimits{}, ignore);
    for (int i = first;; ++i) {
        store->put(numbered(i), i % 2 == 0);
        if (::write(out, &i, sizeof i) != sizeof i) _exit(2);
    }
}

}  // namespace

TEST_CASE("a store that is killed at any moment has all that it acknowledged, whole") {
    const Folder folder;
    std::mt19937 random(7);
    std::uniform_int_distribution<int> pause(0, 40'000);
    std::vector<int> acknowledged;
    int next = 0;
    for (int round = 0; round < 40; ++round) {
        int ends[2];
        REQUIRE(pipe(ends) == 0);
        const pid_t child = fork();
        REQUIRE(child >= 0);
        if (child == 0) putForever(folder.path(), next, ends[1]);
        close(ends[1]);
        // Until the first is acknowledged, then a random while.
        int number = 0;
        while (::read(ends[0], &number, sizeof number) == sizeof number) {
            acknowledged.push_back(number);
            if (number == next)
                std::this_thread::sleep_for(std::chrono::microseconds(pause(random)));
            if (number == next) kill(child, SIGKILL);
        }
        close(ends[0]);
        int status = 0;
        waitpid(child, &status, 0);
        CHECK(WIFSIGNALED(status));
        REQUIRE(!acknowledged.empty());
        next = acknowledged.back() + 2;  // the one after may be there or not
        logged.clear();
        const auto store = openDisk(folder);
        CHECK(logged.size() == 1);  // nothing had to be set aside
        CHECK(folder.files("new") == 0);
        if (round % 10 != 9) continue;
        for (const int i : acknowledged) {
            const auto found = store->get(idOf(numbered(i)));
            INFO("scene " << i << " of round " << round);
            REQUIRE(found);
            CHECK(found->bundle->files == numbered(i).files);
            CHECK(found->entry.listed == (i % 2 == 0));
        }
    }
    CHECK(acknowledged.size() >= 40);
}
