#include "server/scenes.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "scene/digest.h"
#include "server/store/scene_store.h"

namespace farol::server {
namespace {

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

constexpr std::size_t kMaxDigests = 20'000;
constexpr std::size_t kMaxFound = 2'000;
// Two edits within one tick of the clock that stamps files (10 ms at the longest) have one stamp.
constexpr std::chrono::milliseconds kTick{50};

}  // namespace

// Two servers with the same files, or one after a copy, make the same tags.
std::string SceneFolder::digestOf(const scene::Assets& files, const std::string& path) const {
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
    const auto bytes = files.read(path);
    if (!bytes || stamp.empty()) return "";
    std::string digest = scene::contentDigest(*bytes);
    const std::lock_guard lock(mutex_);
    if (digests_.size() >= kMaxDigests) digests_.clear();
    digests_.insert_or_assign(stamp, Digest{digest, firstSeen, now - firstSeen > kTick});
    return digest;
}

std::string SceneFolder::versionOf(const scene::Assets& files) const {
    std::string all;
    for (const std::string& path : files.list())
        all.append(path).append("\n").append(digestOf(files, path)).append("\n");
    return scene::contentDigest(all);
}

SceneFolder::SceneFolder(std::string root)
    : root_(std::move(root)), files_(root_), watch_(root_.empty() ? "" : files_.root()) {}

std::shared_ptr<const scene::Assets> SceneFolder::assets(const ServedScene& scene) const {
    const std::string folder = folderOf(scene.path);
    return std::make_shared<scene::FolderAssets>(folder.empty() ? root_ : root_ + "/" + folder);
}

bool SceneFolder::isPart(const std::string& path) const {
    const std::string folder = folderOf(path);
    if (folder.empty()) return false;
    if (files_.has(folder + "/" + std::string(kUnlistedFile))) return true;
    const std::string main = folder + "/" + std::string(kMainFile);
    return path != main && files_.has(main);
}

std::vector<ServedScene> SceneFolder::list() const {
    std::vector<ServedScene> scenes;
    if (root_.empty()) return scenes;
    std::map<std::string, std::string> versions;  // by folder: many scenes may share one
    for (const std::string& path : files_.list()) {
        if (!path.ends_with(kSuffix) || path.size() == kSuffix.size() || isPart(path) ||
            store::isStoredId(idOf(path)))
            continue;
        ServedScene scene{idOf(path), path, ""};
        auto [entry, isNew] = versions.try_emplace(folderOf(path));
        if (isNew) entry->second = versionOf(*assets(scene));
        scene.version = scene::contentDigest(path + "\n" + entry->second);
        scenes.push_back(std::move(scene));
    }
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
    const auto revision = watch_.revision();
    if (revision) {
        const std::lock_guard lock(mutex_);
        const auto known = found_.find(id);
        if (known != found_.end() && known->second.revision == *revision)
            return known->second.scene;
    }
    auto scene = look(id);
    if (revision && scene) {
        const std::lock_guard lock(mutex_);
        if (found_.size() >= kMaxFound) found_.clear();
        found_.insert_or_assign(id, Found{*revision, *scene});
    }
    return scene;
}

std::optional<ServedScene> SceneFolder::look(const std::string& id) const {
    if (root_.empty() || !scene::isSafePath(id) || store::isStoredId(id)) return std::nullopt;
    for (const std::string& path : {id + "/" + std::string(kMainFile), id + std::string(kSuffix)}) {
        if (!files_.has(path) || idOf(path) != id) continue;
        ServedScene scene{id, path, ""};
        scene.version = scene::contentDigest(path + "\n" + versionOf(*assets(scene)));
        scene.document = digestOf(files_, path);
        return scene;
    }
    return std::nullopt;
}

std::optional<std::string> SceneFolder::source(const ServedScene& scene) const {
    return files_.read(scene.path);
}

}  // namespace farol::server
