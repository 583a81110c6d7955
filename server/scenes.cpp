#include "server/scenes.h"

#include <algorithm>
#include <map>
#include <system_error>
#include <tuple>

#include "core/digest.h"
#include "scene/read/reader.h"
#include "server/messages.h"
#include "server/store/scene_store.h"
#include "worker/backend.h"

namespace farol::server {
namespace {

constexpr int kRetryAfterS = 5;
constexpr std::string_view kSuffix = ".xml";
constexpr std::string_view kMainFile = "scene.xml";
constexpr std::string_view kUnlistedFile = "unlisted.txt";

std::string folderOf(const std::string& path) {
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string idOf(const std::string& path) {
    const std::string folder = folderOf(path);
    if (!folder.empty() && path.substr(folder.size() + 1) == kMainFile) return folder;
    return path.substr(0, path.size() - kSuffix.size());
}

[[noreturn]] void refuse(const std::string& why) {
    throw worker::Busy(message<"busy.scenes">("reason"_arg = uncut(why)), kRetryAfterS);
}

std::string_view baseNameOf(std::string_view path) { return path.substr(path.rfind('/') + 1); }

std::string below(const std::string& root, const std::string& folder) {
    return folder.empty() ? root : root + "/" + folder;
}

constexpr std::string_view kFolder = "is a folder";
constexpr std::size_t kMaxDigests = 20'000;
constexpr std::size_t kMaxDigestBytes = std::size_t{64} << 20U;  // of a file that is read for one
constexpr std::size_t kMaxFound = 2'000;
// Two edits within one tick of the clock that stamps files (10 ms at the longest) have one stamp.
constexpr std::chrono::milliseconds kTick{50};

}  // namespace

std::shared_ptr<SceneFolder::Mounted> SceneFolder::mounted() const {
    if (root_.empty()) return nullptr;
    const auto identity = scene::folderIdentity(root_);
    if (!identity) refuse("it does not exist");
    const std::lock_guard lock(mutex_);
    // A symbolic link in the path may have changed while the folder is the same.
    if (!mounted_ || mounted_->identity != *identity ||
        scene::folderIdentity(mounted_->files.root()) != identity)
        mounted_ = std::make_shared<Mounted>(root_, *identity);
    return mounted_;
}

void SceneFolder::check() const {
    const auto folder = mounted();
    if (!folder) return;
    try {
        folder->files.checkReadable();
    } catch (const std::system_error& fault) {
        refuse(fault.code().message());
    }
}

std::string SceneFolder::watchFault() const {
    const std::lock_guard lock(mutex_);
    return mounted_ ? mounted_->watch.fault() : "";
}

// Two servers with the same files, or one after a copy, make the same tags, but for files that are
// too large to be read for that.
std::string SceneFolder::digestOf(const scene::FolderAssets& files, const std::string& path) const {
    const std::string stamp = files.version(path);
    const auto now = std::chrono::steady_clock::now();
    auto firstSeen = now;
    {
        const std::lock_guard lock(mutex_);
        if (const auto known = digests_.find(stamp); known != digests_.end()) {
            if (known->second.isSure) return known->second.digest;
            firstSeen = known->second.firstSeen;
        }
    }
    if (files.size(path).value_or(0) > kMaxDigestBytes) return contentDigest(stamp);
    const auto bytes = files.read(path);
    if (!bytes || stamp.empty()) return "";
    std::string digest = contentDigest(*bytes);
    const std::lock_guard lock(mutex_);
    if (digests_.size() >= kMaxDigests) digests_.clear();
    digests_.insert_or_assign(stamp, Digest{digest, firstSeen, now - firstSeen > kTick});
    return digest;
}

std::string SceneFolder::versionOf(const scene::FolderAssets& files) const {
    std::string all;
    for (const std::string& path : files.list())
        all.append(path).append("\n").append(digestOf(files, path)).append("\n");
    return contentDigest(all);
}

SceneFolder::SceneFolder(std::string root) : root_(std::move(root)) {
    if (!root_.empty() && scene::folderIdentity(root_)) (void)mounted();
}

std::shared_ptr<const scene::Assets> SceneFolder::assets(const ServedScene& scene) const {
    return std::make_shared<scene::FolderAssets>(below(root_, folderOf(scene.path)));
}

bool SceneFolder::isPart(const scene::FolderAssets& files, const std::string& path) const {
    const std::string folder = folderOf(path);
    if (folder.empty()) return false;
    if (files.has(folder + "/" + std::string(kUnlistedFile))) return true;
    const std::string main = folder + "/" + std::string(kMainFile);
    return path != main && files.has(main);
}

std::vector<ServedScene> SceneFolder::list() const {
    std::vector<ServedScene> scenes;
    const auto folder = mounted();
    if (!folder) return scenes;
    check();
    std::map<std::string, std::string> versions;  // by folder: many scenes may share one
    const auto add = [&](const std::string& path, const std::string& fault) {
        if (!path.ends_with(kSuffix) || path.size() == kSuffix.size() ||
            isPart(folder->files, path) || store::isStoredId(idOf(path)))
            return;
        ServedScene scene{idOf(path), path, ""};
        scene.fault = fault;
        auto [entry, isNew] = versions.try_emplace(folderOf(path));
        if (isNew) entry->second = versionOf(scene::FolderAssets(below(root_, folderOf(path))));
        scene.version = contentDigest(path + "\n" + fault + entry->second);
        scenes.push_back(std::move(scene));
    };
    for (const std::string& path : folder->files.list()) add(path, "");
    for (const auto& odd : folder->files.oddities(kSuffix))
        if (odd.what != kFolder || baseNameOf(odd.path) == kMainFile) add(odd.path, odd.what);
    // a/scene.xml and a.xml share an id; find() takes the former, so it comes first here.
    std::sort(scenes.begin(), scenes.end(), [](const ServedScene& a, const ServedScene& b) {
        const bool aMain = a.path.ends_with("/scene.xml"), bMain = b.path.ends_with("/scene.xml");
        return std::tie(a.id, bMain) < std::tie(b.id, aMain);
    });
    const auto sameId = [](const ServedScene& a, const ServedScene& b) { return a.id == b.id; };
    scenes.erase(std::unique(scenes.begin(), scenes.end(), sameId), scenes.end());
    return scenes;
}

std::optional<ServedScene> SceneFolder::find(const std::string& id) const {
    const auto folder = mounted();
    if (!folder) return std::nullopt;
    const auto revision = folder->watch.revision();
    if (revision) {
        const std::lock_guard lock(folder->mutex);
        const auto known = folder->found.find(id);
        if (known != folder->found.end() && known->second.revision == *revision)
            return known->second.scene;
    }
    auto scene = look(folder->files, id);
    if (revision && scene) {
        const std::lock_guard lock(folder->mutex);
        if (folder->found.size() >= kMaxFound) folder->found.clear();
        folder->found.insert_or_assign(id, Found{*revision, *scene});
    }
    return scene;
}

std::optional<ServedScene> SceneFolder::look(const scene::FolderAssets& files,
                                             const std::string& id) const {
    if (!scene::isSafePath(id) || store::isStoredId(id)) return std::nullopt;
    for (const std::string& path : {id + "/" + std::string(kMainFile), id + std::string(kSuffix)}) {
        if (idOf(path) != id) continue;
        ServedScene scene{id, path, ""};
        if (!files.has(path)) {
            scene.fault = files.oddityOf(path);
            const bool isScene =
                !scene.fault.empty() && (scene.fault != kFolder || baseNameOf(path) == kMainFile);
            if (!isScene) continue;
        }
        scene.version = contentDigest(path + "\n" + scene.fault +
                                      versionOf(scene::FolderAssets(below(root_, folderOf(path)))));
        scene.document = digestOf(files, path);
        return scene;
    }
    return std::nullopt;
}

std::optional<std::string> SceneFolder::source(const ServedScene& scene) const {
    const auto folder = mounted();
    if (!folder) return std::nullopt;
    if (!scene.fault.empty())
        throw Error(message<"asset.unreadable/type">("found"_arg = scene.fault),
                    {scene.path, 0, 0});
    const scene::FolderAssets& files = folder->files;
    if (files.size(scene.path).value_or(0) > scene::ReadLimits{}.bytes)
        throw Error(message<"limit.bytes/scene">("max"_arg = scene::ReadLimits{}.bytes >> 20U),
                    {scene.path, 0, 0});
    auto bytes = files.read(scene.path);
    if (!bytes && files.has(scene.path))
        throw Error(message<"asset.unreadable/permissions">(), {scene.path, 0, 0});
    return bytes;
}

}  // namespace farol::server
