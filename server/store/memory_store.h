#pragma once

#include <functional>
#include <map>
#include <mutex>

#include "server/store/index.h"

namespace farol::server::store {

/// Scenes that live as long as the process.
class MemoryStore final : public SceneStore {
  public:
    explicit MemoryStore(StoreLimits limits) : index_(limits) {}

    /// Stores without a client: may evict any scene, the least recently used first.
    Put put(const scene::Bundle& bundle, bool listed) override;
    Put putFor(const std::string& client, const scene::Bundle& bundle, bool listed) override;
    std::optional<Stored> get(const std::string& id) override;
    bool remove(const std::string& id) override;
    std::vector<Entry> list() override;
    std::size_t expire() override;
    std::uint64_t bytes() const override;

  private:
    Put keep(const std::string* client, const scene::Bundle& bundle, bool listed);
    void drop(const std::string& id);

    mutable std::mutex mutex_;
    Index index_;
    std::map<std::string, std::shared_ptr<const scene::Bundle>> bundles_;
};

}  // namespace farol::server::store
