#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "scene/assets.h"
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

    std::string fileName() const { return path.substr(path.rfind('/') + 1); }
};

/// The scene that a stored one is.
inline ServedScene uploadOf(const store::Entry& entry) { return {entry.id, "", entry.id, entry}; }

/// The folder that is served: looked at anew on every call, so that edits show at once. Nothing
/// outside it is ever found, whatever the id or the links inside say.
class SceneFolder {
  public:
    /// An empty `root` serves no scenes.
    explicit SceneFolder(std::string root);

    /// All scenes in the order of their ids; at most Assets::kMaxListed files are looked at. Left
    /// out: the other documents of a folder that has a scene.xml (they are its parts), and all of a
    /// folder that holds a file unlisted.txt. find() knows them all the same.
    std::vector<ServedScene> list() const;
    std::optional<ServedScene> find(const std::string& id) const;
    /// The document's bytes; nothing if it went away meanwhile.
    std::optional<std::string> source(const ServedScene& scene) const;
    /// The files beside the document.
    std::shared_ptr<const scene::Assets> assets(const ServedScene& scene) const;

  private:
    bool isPart(const std::string& path) const;
    std::string versionOf(const scene::Assets& files) const;
    std::string digestOf(const scene::Assets& files, const std::string& path) const;
    std::string root_;
    scene::FolderAssets files_;
    mutable std::mutex mutex_;
    /// Digests of contents by what tells that a file may have changed. Bounded.
    mutable std::map<std::string, std::string> digests_;
};

}  // namespace farol::server
