#include "server/store/memory_store.h"

#include "scene/error.h"

namespace farol::server::store {
namespace {

Time now() { return std::chrono::system_clock::now(); }

}  // namespace

void MemoryStore::drop(const std::string& id) {
    index_.erase(id);
    bundles_.erase(id);
}

SceneStore::Put MemoryStore::put(const scene::Bundle& bundle, bool listed) {
    Entry entry{idOf(bundle), listed, index_.expiry(now()), bundle.bytes()};
    const std::lock_guard lock(mutex_);
    refuseLargerThan(index_.limits(), entry.bytes);
    const Entry* known = index_.find(entry.id, now());
    const bool created = known == nullptr;
    if (created)
        bundles_[entry.id] = std::make_shared<const scene::Bundle>(bundle);
    else
        entry.listed = entry.listed || known->listed;
    index_.put(entry);
    for (const std::string& id : index_.toEvict(entry.id, now())) drop(id);
    return {entry, created};
}

std::optional<Stored> MemoryStore::get(const std::string& id) {
    const std::lock_guard lock(mutex_);
    const Entry* entry = index_.find(id, now());
    if (entry == nullptr) return std::nullopt;
    index_.touch(id);
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
