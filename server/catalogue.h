#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "render/renderer.h"
#include "server/log.h"
#include "server/scenes.h"
#include "server/store/scene_store.h"
#include "worker/backend.h"

namespace farol::server {

/// All scenes that are served, of the folder and of the store, with cached facts about
/// them. Thread-safe. Calls throw as SceneFolder and SceneStore do.
class Catalogue {
  public:
    /// Facts about a scene that need no render, or the reason why it cannot be read.
    struct Known {
        std::string version;
        render::SceneReport
            report;  ///< without its elements: one for each copy is too much to keep
        Diagnostics errors;
        /// Expiry, for errors that may be temporary.
        std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max();
    };

    /// `folder` as SceneFolder takes it. The others outlive the catalogue.
    Catalogue(const std::string& folder, store::SceneStore& store, worker::Backend& backend,
              Logger& logger);

    /// Throws Error http.not-found.
    ServedScene find(const std::string& id) const;
    /// Returns the job that renders a scene. Sets the scene's document to the one read: its tag is
    /// then of the rendered document, also if the file changed since it was looked up.
    render::Job jobOf(ServedScene& scene) const;
    /// Those of the folder, then those that are listed in the store.
    std::vector<ServedScene> list() const;
    /// Throws Busy where no scene can be read; one that cannot is known by its errors.
    std::shared_ptr<const Known> known(const ServedScene& scene);
    /// Caches the facts about a scene just stored.
    std::shared_ptr<const Known> remember(const std::string& id, const std::string& version,
                                          render::SceneReport report);
    /// Throws Busy where the folder cannot be read now.
    void check() const { folder_.check(); }

  private:
    void inspectInto(Known& facts, const ServedScene& scene) const;
    void keep(const std::string& id, std::shared_ptr<const Known> facts);

    SceneFolder folder_;
    store::SceneStore& store_;
    worker::Backend& backend_;
    Logger& logger_;
    std::mutex mutex_;
    std::map<std::string, std::shared_ptr<const Known>> known_;  ///< by id; bounded
};

}  // namespace farol::server
