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
#include "scene/assets.h"
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

    std::string fileName() const { return path.substr(path.rfind('/') + 1); }
};

/// The scene that a stored one is.
inline ServedScene uploadOf(const store::Entry& entry) { return {entry.id, "", entry.id, entry}; }

/// The folder that is served. Edits show at once: it is looked at anew on every call, but for
/// find() of what was found before while the watch knows of no change. Nothing outside it is ever
/// found, whatever the id or the links inside say.
class SceneFolder {
  public:
    /// An empty `root` serves no scenes.
    explicit SceneFolder(std::string root);

    /// All scenes in the order of their ids; at most Assets::kMaxListed files are looked at. Left
    /// out: the other documents of a folder that has a scene.xml (they are its parts), and all of a
    /// folder that holds a file unlisted.txt. find() knows them all the same.
    std::vector<ServedScene> list() const;
    std::optional<ServedScene> find(const std::string& id) const;
    /// Why every request looks at the files; empty if they are watched.
    std::string watchFault() const { return watch_.fault(); }
    /// The document's bytes; nothing if it went away meanwhile.
    std::optional<std::string> source(const ServedScene& scene) const;
    /// The files beside the document.
    std::shared_ptr<const scene::Assets> assets(const ServedScene& scene) const;

  private:
    bool isPart(const std::string& path) const;
    std::optional<ServedScene> look(const std::string& id) const;
    std::string versionOf(const scene::Assets& files) const;
    std::string digestOf(const scene::Assets& files, const std::string& path) const;
    std::string root_;
    scene::FolderAssets files_;
    mutable std::mutex mutex_;
    struct Digest {
        std::string digest;
        std::chrono::steady_clock::time_point firstSeen;
        bool isSure;  ///< it was read so long after `firstSeen` that another edit has another stamp
    };
    /// Of contents, by what tells that a file may have changed. Bounded.
    mutable std::map<std::string, Digest> digests_;
    mutable FolderWatch watch_;
    struct Found {
        std::uint64_t revision;  ///< of the folder, from before it was looked at
        ServedScene scene;
    };
    mutable std::unordered_map<std::string, Found> found_;  ///< by id; bounded
};

}  // namespace farol::server
