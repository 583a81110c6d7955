#pragma once

#include <list>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "server/store/scene_store.h"

namespace farol::server::store {

/// The index of all stores: scenes, their expiry, the order of eviction. Not
/// thread-safe.
class Index {
  public:
    explicit Index(StoreLimits limits) : limits_(limits) {}

    const StoreLimits& limits() const { return limits_; }
    Time expiry(Time now) const;
    /// Null where there is none, or it has expired.
    const Entry* find(const std::string& id, Time now) const;
    /// Moves the scene to the end of the order of eviction.
    void touch(const std::string& id, Time now = {});
    /// Adds or replaces a scene, at the end of the order. `owner`: the client that sent it.
    void put(const Entry& entry, const std::string& owner = "", Time now = {});
    /// The client that sent a scene; empty where there is none.
    std::string ownerOf(const std::string& id) const;
    /// Returns the limits of one client: a quarter of the store's.
    StoreLimits share() const;
    /// Returns the ids to evict before a client's new scene is put: expired scenes, the client's
    /// oldest over its share, then scenes unused for kProtected, then more of the client's, oldest
    /// first. Nothing if that does not make room: scenes that others use stay.
    std::optional<std::vector<std::string>> roomFor(const Entry& entry, const std::string& client,
                                                    Time now) const;
    static constexpr std::chrono::seconds kProtected{3'600};
    void erase(const std::string& id);
    /// Returns the ids to evict, so that the rest is within the limits. Never `keep`.
    std::vector<std::string> toEvict(const std::string& keep, Time now) const;
    std::vector<std::string> expired(Time now) const;
    std::vector<Entry> listed(Time now) const;
    std::uint64_t bytes() const { return bytes_; }

  private:
    struct Slot {
        Entry entry;
        std::list<std::string>::iterator place;
        std::string owner;
        Time used;
    };
    StoreLimits limits_;
    std::map<std::string, Slot> entries_;
    std::list<std::string> order_;  ///< of eviction
    std::uint64_t bytes_ = 0;
};

}  // namespace farol::server::store
