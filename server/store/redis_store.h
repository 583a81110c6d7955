#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "core/lru_cache.h"
#include "server/store/redis_link.h"
#include "server/store/scene_store.h"
#include "worker/backend.h"

namespace farol::server::store {

/// The refusals of requests while Redis is unreachable, and where it refuses a command.
worker::Busy busyUnreachable();
worker::Busy busyRefused(const RedisRefusal& why);

/// Scenes in a Redis that many services share: a scene acknowledged by one is visible to all.
/// Every change is one script: it is atomic, and Redis's clock applies to all replicas.
/// While Redis is unreachable, put, remove and list throw Busy store.unreachable, and get returns
/// the scenes in this service's memory.
class RedisStore final : public SceneStore {
  public:
    using Log = std::function<void(const std::string&)>;

    /// Does not throw if Redis is unreachable: it may start later.
    /// Records uses of a scene at most once in `usePause`.
    RedisStore(RedisAddress address, StoreLimits limits, Log log,
               std::chrono::microseconds usePause = std::chrono::minutes(1));

    Put put(const scene::Bundle& bundle, bool listed) override;
    std::optional<Stored> get(const std::string& id) override;
    bool remove(const std::string& id) override;
    std::vector<Entry> list() override;
    std::size_t expire() override;
    /// 0 while Redis is unreachable.
    std::uint64_t bytes() const override;
    bool isReachable() const override { return link_.isUp(); }

    static constexpr std::size_t kCachedBytes = std::size_t{64} << 20U;

  private:
    RedisReply run(const char* script, const std::vector<std::string>& arguments) const;
    RedisReply required(const char* script, const std::vector<std::string>& arguments) const;
    void inspectServer();

    const StoreLimits limits_;
    const Log log_;
    const std::string usePause_;
    mutable RedisLink link_;
    mutable std::mutex mutex_;
    /// The scenes requested last, with their entries of that time.
    LruCache<std::string, Stored> cache_{kCachedBytes};
};

}  // namespace farol::server::store
