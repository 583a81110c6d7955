#pragma once

#include <functional>
#include <mutex>
#include <set>
#include <string>

#include "core/lru_cache.h"
#include "server/store/files.h"
#include "server/store/index.h"

namespace farol::server::store {

/// Scenes in a folder, a file each (scene_file.h): `scenes/` holds acknowledged scenes, `new/`
/// unfinished files, `aside/` files with a wrong digest or of other programs. One process at a
/// time. Each file read is checked against its digest: damaged ones are never served. A file that
/// cannot be read stays where it is: its scene is Busy store.failed until it can.
class DiskStore final : public SceneStore {
  public:
    using Log = std::function<void(const std::string&)>;

    /// Reads and checks all that is there. Throws std::runtime_error when the folder cannot be
    /// made or listed, or another process has it.
    DiskStore(std::string folder, StoreLimits limits, Log log);

    Put put(const scene::Bundle& bundle, bool listed) override;
    std::optional<Stored> get(const std::string& id) override;
    bool remove(const std::string& id) override;
    std::vector<Entry> list() override;
    std::size_t expire() override;
    std::uint64_t bytes() const override;

    static constexpr std::size_t kCachedBytes = std::size_t{64} << 20U;

  private:
    enum class Loaded { whole, missing, rejected, failed };

    std::string pathOf(const std::string& id) const;
    void takeStock();
    Loaded load(const std::string& path, Stored& scene, int& error) const;
    bool isUnread(const std::string& id) const;
    void readAgain(const std::string& id);
    std::optional<Stored> reload(const std::string& id);
    void setAside(const std::string& path, const std::string& why);
    bool drop(const std::string& id);

    const std::string folder_;
    const Log log_;
    Descriptor lock_;
    std::mutex writing_;  ///< held while files change; taken before mutex_
    mutable std::mutex mutex_;
    Index index_;
    std::set<std::string> unread_;  ///< ids of files that could not be read yet
    LruCache<std::string, std::shared_ptr<const scene::Bundle>> cache_{kCachedBytes};
};

}  // namespace farol::server::store
