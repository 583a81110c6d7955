#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/files/bundle.h"

/// Storage of uploaded scenes.
namespace farol::server::store {

using Time = std::chrono::system_clock::time_point;
/// Returns the time by which scenes expire.
inline Time now() { return std::chrono::system_clock::now(); }

/// Facts about a stored scene that need no decoding.
struct Entry {
    std::string id;           ///< "~" and the digest of the bundle
    bool listed = false;      ///< in the gallery; else found by its id only
    Time expires;             ///< Time::max(): never
    std::uint64_t bytes = 0;  ///< its size in the store
    bool operator==(const Entry&) const = default;
};

struct Stored {
    Entry entry;
    std::shared_ptr<const scene::Bundle> bundle;
};

struct StoreLimits {
    std::uint64_t bytes = std::uint64_t{1} << 30U;  ///< of all scenes together
    std::size_t scenes = 100'000;
    std::chrono::seconds expire{7 * 24 * 3600};  ///< after the last upload; 0: never
};

/// Scenes by the digest of their content. Thread-safe. Failed calls throw Busy store.full,
/// store.failed or store.unreachable and change nothing.
class SceneStore {
  public:
    virtual ~SceneStore() = default;

    struct Put {
        Entry entry;
        bool created = false;  ///< it was not there before
    };
    /// Stores the bundle before it returns. The expiry of a bundle that is there already
    /// starts anew; `listed` is set and never cleared. A full store evicts the least recently
    /// requested scenes. Throws Error limit.store for a bundle that alone is larger than the
    /// store.
    virtual Put put(const scene::Bundle& bundle, bool listed) = 0;
    /// The same on behalf of a client. A store in memory gives one client a share of its room, and
    /// evicts only the client's own scenes and scenes unused for an hour. Throws Busy store.full
    /// where that is not enough.
    virtual Put putFor(const std::string& client, const scene::Bundle& bundle, bool listed) {
        static_cast<void>(client);
        return put(bundle, listed);
    }
    /// The scene, unless it is not here, expired or damaged.
    virtual std::optional<Stored> get(const std::string& id) = 0;
    /// False where there was none.
    virtual bool remove(const std::string& id) = 0;
    /// Those that are listed, by their ids.
    virtual std::vector<Entry> list() = 0;
    /// Removes expired scenes; returns their number.
    virtual std::size_t expire() = 0;
    /// How much is kept.
    virtual std::uint64_t bytes() const = 0;
    /// Returns whether the last call reached the storage: false while a shared store is away.
    virtual bool isReachable() const { return true; }
};

/// The id of a bundle: "~" and 32 hexadecimal digits.
std::string idOf(const scene::Bundle& bundle);
/// Whether an id is of that form; no served scene is found under one.
bool isStoredId(const std::string& id);
/// Throws Error limit.store.
void refuseLargerThan(const StoreLimits& limits, std::uint64_t bytes);

}  // namespace farol::server::store
