#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "render/lru.h"
#include "server/store/files.h"
#include "server/store/index.h"

namespace farol::server::store {

/// Scenes in a folder, a file each (scene_file.h): `scenes/` holds what was acknowledged, `new/`
/// what is being written, `aside/` what was found damaged or is not ours. One process at a time.
/// What is read is checked against its digest, so that nothing damaged is served.
class DiskStore final : public SceneStore {
  public:
    using Log = std::function<void(const std::string&)>;

    /// Reads and checks all that is there. Throws std::runtime_error when the folder cannot be
    /// made, or another process has it.
    DiskStore(std::string folder, StoreLimits limits, Log log);

    Put put(const scene::Bundle& bundle, bool listed) override;
    std::optional<Stored> get(const std::string& id) override;
    bool remove(const std::string& id) override;
    std::vector<Entry> list() override;
    std::size_t expire() override;
    std::uint64_t bytes() const override;

    static constexpr std::size_t kCachedBytes = std::size_t{64} << 20U;

  private:
    std::string pathOf(const std::string& id) const;
    void takeStock();
    void setAside(const std::string& path, const std::string& why);
    bool drop(const std::string& id);

    const std::string folder_;
    const Log log_;
    Descriptor lock_;
    std::mutex writing_;  ///< held while files change; taken before mutex_
    mutable std::mutex mutex_;
    Index index_;
    render::LruCache<std::string, std::shared_ptr<const scene::Bundle>> cache_{kCachedBytes};
};

}  // namespace farol::server::store
