#include "server/store/memory_store.h"

#include "core/error.h"
#include "server/messages.h"
#include "worker/backend.h"

namespace farol::server::store {
namespace {
constexpr int kRoomRetryS = 60;
}  // namespace

void MemoryStore::drop(const std::string& id) {
    index_.erase(id);
    bundles_.erase(id);
}

SceneStore::Put MemoryStore::put(const scene::Bundle& bundle, bool listed) {
    return keep(nullptr, bundle, listed);
}

SceneStore::Put MemoryStore::putFor(const std::string& client, const scene::Bundle& bundle,
                                    bool listed) {
    return keep(&client, bundle, listed);
}

SceneStore::Put MemoryStore::keep(const std::string* client, const scene::Bundle& bundle,
                                  bool listed) {
    Entry entry{idOf(bundle), listed, index_.expiry(now()), bundle.bytes()};
    const std::lock_guard lock(mutex_);
    refuseLargerThan(client == nullptr ? index_.limits() : index_.share(), entry.bytes);
    const Entry* known = index_.find(entry.id, now());
    const bool created = known == nullptr;
    if (!created) {
        // It keeps the owner of its first upload.
        entry.listed = entry.listed || known->listed;
        index_.put(entry, index_.ownerOf(entry.id), now());
        return {entry, false};
    }
    if (client != nullptr) {
        const auto room = index_.roomFor(entry, *client, now());
        if (!room) throw worker::Busy(message<"store.full/room">(), kRoomRetryS);
        for (const std::string& id : *room) drop(id);
    }
    bundles_[entry.id] = std::make_shared<const scene::Bundle>(bundle);
    index_.put(entry, client == nullptr ? "" : *client, now());
    for (const std::string& id : index_.toEvict(entry.id, now())) drop(id);
    return {entry, created};
}

std::optional<Stored> MemoryStore::get(const std::string& id) {
    const std::lock_guard lock(mutex_);
    const Entry* entry = index_.find(id, now());
    if (entry == nullptr) return std::nullopt;
    index_.touch(id, now());
    return Stored{*entry, bundles_.at(id)};
}

bool MemoryStore::remove(const std::string& id) {
    const std::lock_guard lock(mutex_);
    const bool known = index_.find(id, now()) != nullptr;
    drop(id);
    return known;
}

std::vector<Entry> MemoryStore::list() {
    const std::lock_guard lock(mutex_);
    return index_.listed(now());
}

std::size_t MemoryStore::expire() {
    const std::lock_guard lock(mutex_);
    const std::vector<std::string> ids = index_.expired(now());
    for (const std::string& id : ids) drop(id);
    return ids.size();
}

std::uint64_t MemoryStore::bytes() const {
    const std::lock_guard lock(mutex_);
    return index_.bytes();
}

}  // namespace farol::server::store
