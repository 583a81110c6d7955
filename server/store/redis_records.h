#pragma once

#include <functional>
#include <string>

#include "server/store/record_store.h"
#include "server/store/redis_link.h"

namespace farol::server::store {

/// Records in a Redis that many services share. Every call is one script: tries are counted once
/// across all services, by Redis's clock. While Redis is unreachable, calls throw Busy
/// store.unreachable.
class RedisRecords final : public RecordStore {
  public:
    using Log = std::function<void(const std::string&)>;

    /// `maxBytes`: of all records together. Does not throw if Redis is unreachable.
    RedisRecords(RedisAddress address, std::uint64_t maxBytes, Log log);

    void put(const std::string& table, const std::string& key, const std::string& bytes,
             Time expires) override;
    std::optional<std::string> get(const std::string& table, const std::string& key) override;
    bool remove(const std::string& table, const std::string& key) override;
    std::vector<std::string> keys(const std::string& table) override;
    std::size_t expire() override;
    Tries take(const std::string& table, const std::string& key, const TryLimits& limits) override;

  private:
    RedisReply run(const char* script, const std::vector<std::string>& arguments);

    const std::string maxBytes_;
    const Log log_;
    RedisLink link_;
};

}  // namespace farol::server::store
