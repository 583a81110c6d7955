#include "server/store/disk_store.h"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <utility>

#include "server/messages.h"
#include "server/store/scene_file.h"
#include "worker/backend.h"

namespace farol::server::store {
namespace fs = std::filesystem;
namespace {

constexpr const char* kEnding = ".scene";
constexpr std::size_t kMaxFileBytes = std::size_t{2} << 30U;  // more than a body can be
constexpr int kMaxSameName = 1'000;                           // files of one name in aside/
constexpr int kRetryAfterS = 60;
constexpr int kRetryAfterReadS = 5;

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
        throw worker::Busy(message<"store.full">(), kRetryAfterS);
    throw worker::Busy(message<"store.failed">(), kRetryAfterS);
}

[[noreturn]] void refuseReading() {
    throw worker::Busy(message<"store.failed/read">(), kRetryAfterReadS);
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
    const auto isFree = [](const fs::path& target) {
        std::error_code failed;
        return fs::symlink_status(target, failed).type() == fs::file_type::not_found;
    };
    fs::path to = fs::path(folder_) / "aside" / name;
    for (int i = 1; !isFree(to) && i < kMaxSameName; ++i)
        to = fs::path(folder_) / "aside" / (name + "." + std::to_string(i));
    std::error_code failed = std::make_error_code(std::errc::file_exists);
    if (isFree(to)) fs::rename(path, to, failed);
    if (failed)
        log_(name + " stays in the store and is not served: " + why +
             "; cannot be set aside: " + failed.message());
    else
        log_(name + " is set aside: " + why);
}

// Only a wrong digest means damage. All other failures are not the file's fault.
DiskStore::Loaded DiskStore::load(const std::string& path, Stored& scene, int& error) const {
    const FileContent file = readWhole(path, kMaxFileBytes);
    error = file.error;
    switch (file.kind) {
        case FileContent::Kind::missing:
            return Loaded::missing;
        case FileContent::Kind::foreign:
            return Loaded::rejected;
        case FileContent::Kind::failed:
            return Loaded::failed;
        case FileContent::Kind::whole:
            break;
    }
    try {
        auto decoded = decodeScene(file.bytes);
        if (!decoded || pathOf(decoded->entry.id) != path) return Loaded::rejected;
        scene = std::move(*decoded);
        return Loaded::whole;
    } catch (const std::bad_alloc&) {
        error = ENOMEM;
        return Loaded::failed;
    }
}

bool DiskStore::isUnread(const std::string& id) const {
    const std::lock_guard lock(mutex_);
    return unread_.count(id) > 0;
}

void DiskStore::takeStock() {
    std::error_code ignored;  // a file that cannot be removed is overwritten
    for (const auto& left : fs::directory_iterator(folder_ + "/new"))
        fs::remove(left.path(), ignored);
    std::vector<std::pair<fs::file_time_type, Entry>> found;
    std::vector<std::string> rejected;
    for (const auto& file : fs::directory_iterator(folder_ + "/scenes")) {
        const std::string path = file.path().string();
        Stored scene;
        int error = 0;
        switch (load(path, scene, error)) {
            case Loaded::whole:
                found.emplace_back(file.last_write_time(ignored), scene.entry);
                break;
            case Loaded::missing:
                break;
            case Loaded::rejected:
                rejected.push_back(path);
                break;
            case Loaded::failed:
                log_(file.path().filename().string() +
                     " cannot be read and stays: " + std::strerror(error));
                if (const std::string id = "~" + file.path().stem().string(); isStoredId(id))
                    unread_.insert(id);
        }
    }
    for (const std::string& path : rejected) setAside(path, "it is damaged or not a stored scene");
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [written, entry] : found) index_.put(entry);
    for (const std::string& id : index_.toEvict("", now())) drop(id);
    log_(std::to_string(found.size()) + " scenes, " + std::to_string(index_.bytes()) + " bytes");
}

// The caller holds writing_. Throws Busy while the file cannot be read.
void DiskStore::readAgain(const std::string& id) {
    Stored scene;
    int error = 0;
    const Loaded loaded = load(pathOf(id), scene, error);
    if (loaded == Loaded::failed) refuseReading();
    if (loaded == Loaded::rejected) setAside(pathOf(id), "it is damaged or not a stored scene");
    const std::lock_guard lock(mutex_);
    unread_.erase(id);
    if (loaded == Loaded::whole) index_.put(scene.entry);
}

// The caller holds writing_, or no other thread exists.
bool DiskStore::drop(const std::string& id) {
    if (const int failed = removeDurably(pathOf(id)); failed != 0) {
        log_(id + " cannot be removed: " + std::strerror(failed));
        return false;
    }
    const std::lock_guard lock(mutex_);
    index_.erase(id);
    unread_.erase(id);
    return true;
}

SceneStore::Put DiskStore::put(const scene::Bundle& bundle, bool listed) {
    Stored scene;
    Entry& entry = scene.entry;
    entry.id = idOf(bundle);
    entry.listed = listed;
    scene.bundle = std::make_shared<const scene::Bundle>(bundle);
    const std::lock_guard alone(writing_);
    if (isUnread(entry.id)) readAgain(entry.id);  // whether it is listed is in the file alone
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
    std::error_code unknown;
    const bool hadFile = fs::exists(path, unknown) || unknown;
    if (const int failed = writeDurably(temporary, path, file); failed != 0) {
        log_(entry.id + " cannot be stored: " + std::strerror(failed));
        if (!hadFile) removeDurably(path);  // whole, if only the last step failed
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
    if (isUnread(id)) {
        const std::lock_guard alone(writing_);
        if (isUnread(id)) readAgain(id);
    }
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
    Stored read;
    int error = 0;
    const Loaded loaded = load(pathOf(id), read, error);
    if (loaded == Loaded::failed) {
        log_(id + " cannot be read: " + std::strerror(error));
        refuseReading();
    }
    if (loaded != Loaded::whole) return reload(id);
    scene.bundle = std::move(read.bundle);
    const std::lock_guard lock(mutex_);
    if (cache_.find(id) == nullptr) cache_.put(id, scene.bundle, scene.bundle->bytes());
    return scene;
}

// Reads again under writing_: during the first read, the scene may have been removed and uploaded
// again.
std::optional<Stored> DiskStore::reload(const std::string& id) {
    const std::lock_guard alone(writing_);
    Stored scene;
    {
        const std::lock_guard lock(mutex_);
        const Entry* entry = index_.find(id, now());
        if (entry == nullptr) return std::nullopt;
        scene.entry = *entry;
    }
    Stored read;
    int error = 0;
    Loaded loaded = load(pathOf(id), read, error);
    std::error_code failed;
    if (loaded == Loaded::missing && !fs::is_directory(folder_ + "/scenes", failed)) {
        loaded = Loaded::failed;  // the disk is missing, not the scene
        error = ENOENT;
    }
    if (loaded == Loaded::whole) {
        scene.bundle = std::move(read.bundle);
        return scene;
    }
    if (loaded == Loaded::failed) {
        log_(id + " cannot be read: " + std::strerror(error));
        refuseReading();
    }
    if (loaded == Loaded::rejected)
        setAside(pathOf(id), "it is damaged");
    else
        log_(id + " is gone from the folder");
    const std::lock_guard lock(mutex_);
    index_.erase(id);
    return std::nullopt;
}

bool DiskStore::remove(const std::string& id) {
    const std::lock_guard alone(writing_);
    {
        const std::lock_guard lock(mutex_);
        if (index_.find(id, now()) == nullptr && unread_.count(id) == 0) return false;
    }
    if (!drop(id)) throw worker::Busy(message<"store.failed/remove">(), kRetryAfterS);
    return true;
}

std::vector<Entry> DiskStore::list() {
    const std::lock_guard lock(mutex_);
    return index_.listed(now());
}

std::size_t DiskStore::expire() {
    const std::lock_guard alone(writing_);
    std::vector<std::string> ids, unread;
    {
        const std::lock_guard lock(mutex_);
        ids = index_.expired(now());
        unread.assign(unread_.begin(), unread_.end());
    }
    for (const std::string& id : unread) {
        try {
            readAgain(id);
        } catch (const worker::Busy&) {
            continue;  // the next sweep tries again
        }
    }
    return static_cast<std::size_t>(
        std::count_if(ids.begin(), ids.end(), [this](const std::string& id) { return drop(id); }));
}

std::uint64_t DiskStore::bytes() const {
    const std::lock_guard lock(mutex_);
    return index_.bytes();
}

}  // namespace farol::server::store
