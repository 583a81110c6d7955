#pragma once

#include <list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/store/scene_store.h"

namespace farol::server::store {

/// What stores have in common: which scenes there are, which expire, which go first. Not for
/// several threads at once.
class Index {
  public:
    explicit Index(StoreLimits limits) : limits_(limits) {}

    const StoreLimits& limits() const { return limits_; }
    Time expiry(Time now) const;
    /// Null where there is none, or it has expired.
    const Entry* find(const std::string& id, Time now) const;
    /// The scene is now the last to go.
    void touch(const std::string& id);
    /// Adds or replaces; the scene is now the last to go.
    void put(const Entry& entry);
    void erase(const std::string& id);
    /// The ids to remove, so that the rest is within the limits. Never `keep`.
    std::vector<std::string> toEvict(const std::string& keep, Time now) const;
    std::vector<std::string> expired(Time now) const;
    std::vector<Entry> listed(Time now) const;
    std::uint64_t bytes() const { return bytes_; }

  private:
    struct Slot {
        Entry entry;
        std::list<std::string>::iterator place;
    };
    StoreLimits limits_;
    std::map<std::string, Slot> entries_;
    std::list<std::string> order_;  ///< the first to go first
    std::uint64_t bytes_ = 0;
};

}  // namespace farol::server::store
