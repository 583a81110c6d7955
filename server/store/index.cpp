#include "server/store/index.h"

#include <algorithm>

namespace farol::server::store {

Time Index::expiry(Time now) const {
    return limits_.expire.count() == 0 ? Time::max() : now + limits_.expire;
}

const Entry* Index::find(const std::string& id, Time now) const {
    const auto found = entries_.find(id);
    if (found == entries_.end() || found->second.entry.expires <= now) return nullptr;
    return &found->second.entry;
}

void Index::touch(const std::string& id) {
    if (const auto found = entries_.find(id); found != entries_.end())
        order_.splice(order_.end(), order_, found->second.place);
}

void Index::put(const Entry& entry) {
    erase(entry.id);
    order_.push_back(entry.id);
    entries_.emplace(entry.id, Slot{entry, std::prev(order_.end())});
    bytes_ += entry.bytes;
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
