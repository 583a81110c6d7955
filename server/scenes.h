#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "render/renderer.h"
#include "scene/files/assets.h"
#include "server/folder_watch.h"
#include "server/store/scene_store.h"

namespace farol::server {

/// One scene of the served folder, or an upload. In the folder the id is its path without ".xml",
/// or its folder's path when the file is named scene.xml: "solar-system" is solar-system/scene.xml
/// or solar-system.xml.
struct ServedScene {
    std::string id;
    std::string path;                         ///< of the document, below the served folder
    std::string version;                      ///< digest of the document and the files beside it
    std::optional<store::Entry> stored = {};  ///< of an upload: it is not in the folder
    std::string document = {};                ///< digest of the document alone; "" of an upload
    std::string fault = {};  ///< the type of an entry that is no document: "is a pipe"

    std::string fileName() const { return path.substr(path.rfind('/') + 1); }
};

/// Returns an uploaded scene as a served one.
inline ServedScene uploadOf(const store::Entry& entry) { return {entry.id, "", entry.id, entry}; }

/// The folder that is served. Edits show at once: each call reads the folder anew, except that
/// find() caches its results until the watch reports a change. Another folder under the same path
/// is noticed at the next call. No id and no link leads to a file outside the folder. Calls throw
/// Busy busy.scenes while the folder cannot be read, and std::system_error where descriptors or
/// memory run out.
class SceneFolder {
  public:
    /// An empty `root` serves no scenes.
    explicit SceneFolder(std::string root);

    /// Returns all scenes by id; reads at most Assets::kMaxListed files. A document that is no
    /// file is among them, with its fault. Leaves out the other documents of a folder that has a
    /// scene.xml (they are its parts), and all of a folder with a file unlisted.txt. find()
    /// finds those, too.
    std::vector<ServedScene> list() const;
    std::optional<ServedScene> find(const std::string& id) const;
    /// Throws Busy busy.scenes where the folder cannot be read now.
    void check() const;
    /// Returns the reason why every request reads the folder; empty if it is watched.
    std::string watchFault() const;
    /// Returns the document's bytes; nothing if it was removed. Throws Error asset.unreadable if it
    /// cannot be read, limit.bytes if it is larger than any document may be.
    std::optional<std::string> source(const ServedScene& scene) const;
    /// The files beside the document.
    std::shared_ptr<const scene::Assets> assets(const ServedScene& scene) const;

  private:
    struct Found {
        std::uint64_t revision;  ///< of the folder, taken before reading it
        ServedScene scene;
    };
    /// The folder as it is now: another one under the same path gets its own.
    struct Mounted {
        Mounted(const std::string& root, const scene::FolderIdentity& folder)
            : identity(folder), files(root), watch(files.root()) {}
        const scene::FolderIdentity identity;
        const scene::FolderAssets files;
        FolderWatch watch;
        std::mutex mutex;
        std::unordered_map<std::string, Found> found;  ///< by id; bounded
    };

    std::shared_ptr<Mounted> mounted() const;
    bool isPart(const scene::FolderAssets& files, const std::string& path) const;
    std::optional<ServedScene> look(const scene::FolderAssets& files, const std::string& id) const;
    std::string versionOf(const scene::FolderAssets& files) const;
    std::string digestOf(const scene::FolderAssets& files, const std::string& path) const;

    const std::string root_;
    mutable std::mutex mutex_;
    mutable std::shared_ptr<Mounted> mounted_;
    struct Digest {
        std::string digest;
        std::chrono::steady_clock::time_point firstSeen;
        bool isSure;  ///< it was read so long after `firstSeen` that another edit has another stamp
    };
    /// Digests of file contents, by FolderAssets::version. Bounded.
    mutable std::map<std::string, Digest> digests_;
};

}  // namespace farol::server
