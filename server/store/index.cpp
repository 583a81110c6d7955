#include "server/store/index.h"

#include <algorithm>
#include <utility>

namespace farol::server::store {

Time Index::expiry(Time now) const {
    return limits_.expire.count() == 0 ? Time::max() : now + limits_.expire;
}

const Entry* Index::find(const std::string& id, Time now) const {
    const auto found = entries_.find(id);
    if (found == entries_.end() || found->second.entry.expires <= now) return nullptr;
    return &found->second.entry;
}

void Index::touch(const std::string& id, Time now) {
    const auto found = entries_.find(id);
    if (found == entries_.end()) return;
    order_.splice(order_.end(), order_, found->second.place);
    found->second.used = now;
}

void Index::put(const Entry& entry, const std::string& owner, Time now) {
    // Allocations come first: if one fails, the old entry stays.
    Slot slot{entry, {}, owner, now};
    std::list<std::string> place{entry.id};
    const auto found = entries_.find(entry.id);
    if (found == entries_.end()) {
        slot.place = place.begin();
        entries_.emplace(entry.id, std::move(slot));
    } else {
        bytes_ -= found->second.entry.bytes;
        order_.erase(found->second.place);
        slot.place = place.begin();
        found->second = std::move(slot);
    }
    order_.splice(order_.end(), place);
    bytes_ += entry.bytes;
}

std::string Index::ownerOf(const std::string& id) const {
    const auto found = entries_.find(id);
    return found == entries_.end() ? "" : found->second.owner;
}

StoreLimits Index::share() const {
    constexpr std::uint64_t kParts = 4;
    StoreLimits share = limits_;
    share.bytes = std::max<std::uint64_t>(1, limits_.bytes / kParts);
    share.scenes = std::max<std::size_t>(1, limits_.scenes / kParts);
    return share;
}

std::optional<std::vector<std::string>> Index::roomFor(const Entry& entry,
                                                       const std::string& client, Time now) const {
    struct Use {
        std::uint64_t bytes;
        std::size_t scenes;
        bool fits(const StoreLimits& limits) const {
            return bytes <= limits.bytes && scenes <= limits.scenes;
        }
    };
    Use all{bytes_ + entry.bytes, entries_.size() + 1}, own{entry.bytes, 1};
    std::vector<const Slot*> slots;  // in the order of eviction
    for (const std::string& id : order_) {
        slots.push_back(&entries_.at(id));
        if (slots.back()->owner != client) continue;
        own.bytes += slots.back()->entry.bytes;
        ++own.scenes;
    }
    std::vector<std::string> ids;
    const auto evict = [&](const auto& isDone, const auto& mayGo) {
        for (const Slot*& slot : slots) {
            if (isDone()) return;
            if (slot == nullptr || !mayGo(*slot)) continue;
            ids.push_back(slot->entry.id);
            all = {all.bytes - slot->entry.bytes, all.scenes - 1};
            if (slot->owner == client) own = {own.bytes - slot->entry.bytes, own.scenes - 1};
            slot = nullptr;
        }
    };
    const auto isOwn = [&](const Slot& slot) { return slot.owner == client; };
    const auto fits = [&] { return all.fits(limits_); };
    evict([] { return false; }, [&](const Slot& slot) { return slot.entry.expires <= now; });
    evict([&] { return own.fits(share()); }, isOwn);
    evict(fits, [&](const Slot& slot) { return slot.used + kProtected <= now; });
    evict(fits, isOwn);
    if (!fits()) return std::nullopt;
    return ids;
}

void Index::erase(const std::string& id) {
    const auto found = entries_.find(id);
    if (found == entries_.end()) return;
    bytes_ -= found->second.entry.bytes;
    order_.erase(found->second.place);
    entries_.erase(found);
}

std::vector<std::string> Index::toEvict(const std::string& keep, Time now) const {
    std::vector<std::string> ids = expired(now);
    std::uint64_t left = bytes_;
    for (const std::string& id : ids) left -= entries_.at(id).entry.bytes;
    const auto fits = [&] {
        return left <= limits_.bytes && entries_.size() - ids.size() <= limits_.scenes;
    };
    for (auto at = order_.begin(); at != order_.end() && !fits(); ++at) {
        const Entry& entry = entries_.at(*at).entry;
        if (entry.id == keep || entry.expires <= now) continue;
        left -= entry.bytes;
        ids.push_back(entry.id);
    }
    return ids;
}

std::vector<std::string> Index::expired(Time now) const {
    std::vector<std::string> ids;
    for (const auto& [id, slot] : entries_)
        if (slot.entry.expires <= now) ids.push_back(id);
    return ids;
}

std::vector<Entry> Index::listed(Time now) const {
    std::vector<Entry> all;
    for (const auto& [id, slot] : entries_)
        if (slot.entry.listed && slot.entry.expires > now) all.push_back(slot.entry);
    return all;
}

}  // namespace farol::server::store
