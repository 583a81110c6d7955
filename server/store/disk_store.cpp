#include "server/store/disk_store.h"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "server/backend.h"
#include "server/store/scene_file.h"

namespace farol::server::store {
namespace fs = std::filesystem;
namespace {

constexpr const char* kEnding = ".scene";
constexpr std::size_t kMostBytes = std::size_t{2} << 30U;  // of one file: more than a body can be
constexpr int kRetryAfterS = 60;

Time now() { return std::chrono::system_clock::now(); }

std::string made(const std::string& folder) {
    std::error_code failed;
    for (const char* below : {"scenes", "new", "aside"})
        if (!failed) fs::create_directories(fs::path(folder) / below, failed);
    if (failed)
        throw std::runtime_error("the folder " + folder +
                                 " for scenes cannot be made: " + failed.message());
    return fs::canonical(folder).string();
}

[[noreturn]] void refuse(int error) {
    if (error == ENOSPC || error == EDQUOT || error == EFBIG)
        throw Busy("store.full", "There is no room to store the scene.", kRetryAfterS);
    throw Busy("store.failed", "The scene could not be stored.", kRetryAfterS);
}

}  // namespace

DiskStore::DiskStore(std::string folder, StoreLimits limits, Log log)
    : folder_(made(folder)),
      log_(std::move(log)),
      lock_(open((folder_ + "/lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)),
      index_(limits) {
    if (lock_.fd() < 0 || flock(lock_.fd(), LOCK_EX | LOCK_NB) != 0)
        throw std::runtime_error(
            "the folder " + folder_ + " for scenes cannot be locked: " +
            (errno == EWOULDBLOCK ? "another process serves from it" : std::strerror(errno)));
    takeStock();
}

std::string DiskStore::pathOf(const std::string& id) const {
    return folder_ + "/scenes/" + id.substr(1) + kEnding;
}

void DiskStore::setAside(const std::string& path, const std::string& why) {
    const std::string name = fs::path(path).filename().string();
    std::error_code failed;
    fs::path to = fs::path(folder_) / "aside" / name;
    for (int i = 1; fs::exists(to, failed) && i < 1000; ++i)
        to = fs::path(folder_) / "aside" / (name + "." + std::to_string(i));
    fs::rename(path, to, failed);
    log_(name + " is set aside: " + why + (failed ? " (" + failed.message() + ")" : ""));
}

void DiskStore::takeStock() {
    std::error_code ignored;  // what cannot be removed is written over
    for (const auto& left : fs::directory_iterator(folder_ + "/new"))
        fs::remove(left.path(), ignored);
    std::vector<std::pair<fs::file_time_type, Entry>> found;
    for (const auto& file : fs::directory_iterator(folder_ + "/scenes")) {
        const std::string path = file.path().string();
        const auto bytes = readWhole(path, kMostBytes);
        const auto scene = bytes ? decodeScene(*bytes) : std::nullopt;
        if (!scene || pathOf(scene->entry.id) != path)
            setAside(path, bytes ? "it is damaged or not a stored scene" : "it cannot be read");
        else
            found.emplace_back(file.last_write_time(ignored), scene->entry);
    }
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [written, entry] : found) index_.put(entry);
    for (const std::string& id : index_.toEvict("", now())) drop(id);
    log_(std::to_string(found.size()) + " scenes, " + std::to_string(index_.bytes()) + " bytes");
}

// The caller holds writing_, or is the only one.
bool DiskStore::drop(const std::string& id) {
    if (const int failed = removeDurably(pathOf(id)); failed != 0) {
        log_(id + " cannot be removed: " + std::strerror(failed));
        return false;
    }
    const std::lock_guard lock(mutex_);
    index_.erase(id);
    return true;
}

SceneStore::Put DiskStore::put(const scene::Bundle& bundle, bool listed) {
    Stored scene;
    Entry& entry = scene.entry;
    entry.id = idOf(bundle);
    entry.listed = listed;
    scene.bundle = std::make_shared<const scene::Bundle>(bundle);
    const std::lock_guard alone(writing_);
    bool created = true;
    {
        const std::lock_guard lock(mutex_);
        entry.expires = index_.expiry(now());
        if (const Entry* known = index_.find(entry.id, now())) {
            created = false;
            entry.listed = entry.listed || known->listed;
        }
    }
    const std::string file = encodeScene(scene);
    entry.bytes = file.size();
    refuseLargerThan(index_.limits(), entry.bytes);
    const std::string path = pathOf(entry.id);
    const std::string temporary = folder_ + "/new/" + fs::path(path).filename().string();
    if (const int failed = writeDurably(temporary, path, file); failed != 0) {
        log_(entry.id + " cannot be stored: " + std::strerror(failed));
        refuse(failed);
    }
    std::vector<std::string> leaving;
    {
        const std::lock_guard lock(mutex_);
        index_.put(entry);
        leaving = index_.toEvict(entry.id, now());
    }
    for (const std::string& id : leaving) drop(id);
    return {entry, created};
}

std::optional<Stored> DiskStore::get(const std::string& id) {
    Stored scene;
    {
        const std::lock_guard lock(mutex_);
        const Entry* entry = index_.find(id, now());
        if (entry == nullptr) return std::nullopt;
        scene.entry = *entry;
        index_.touch(id);
        if (const auto* kept = cache_.find(id)) {
            scene.bundle = *kept;
            return scene;
        }
    }
    const auto bytes = readWhole(pathOf(id), kMostBytes);
    auto read = bytes ? decodeScene(*bytes) : std::nullopt;
    if (!read || read->entry.id != id) {
        const std::lock_guard alone(writing_);
        const std::lock_guard lock(mutex_);
        // Gone meanwhile, or damaged since the start.
        if (index_.find(id, now()) != nullptr) setAside(pathOf(id), "it is damaged");
        index_.erase(id);
        return std::nullopt;
    }
    scene.bundle = std::move(read->bundle);
    const std::lock_guard lock(mutex_);
    if (cache_.find(id) == nullptr) cache_.put(id, scene.bundle, scene.bundle->bytes());
    return scene;
}

bool DiskStore::remove(const std::string& id) {
    const std::lock_guard alone(writing_);
    {
        const std::lock_guard lock(mutex_);
        if (index_.find(id, now()) == nullptr) return false;
    }
    if (!drop(id)) throw Busy("store.failed", "The scene could not be removed.", kRetryAfterS);
    return true;
}

std::vector<Entry> DiskStore::list() {
    const std::lock_guard lock(mutex_);
    return index_.listed(now());
}

std::size_t DiskStore::expire() {
    const std::lock_guard alone(writing_);
    std::vector<std::string> ids;
    {
        const std::lock_guard lock(mutex_);
        ids = index_.expired(now());
    }
    return static_cast<std::size_t>(
        std::count_if(ids.begin(), ids.end(), [this](const std::string& id) { return drop(id); }));
}

std::uint64_t DiskStore::bytes() const {
    const std::lock_guard lock(mutex_);
    return index_.bytes();
}

}  // namespace farol::server::store
