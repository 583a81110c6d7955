#include "server/worker/quarantine.h"

#include <algorithm>

namespace farol::server::worker {

std::chrono::seconds Quarantine::left(const std::string& scene, Clock::time_point now) {
    const std::lock_guard lock(mutex_);
    const auto found = entries_.find(scene);
    if (found == entries_.end() || found->second.strikes < kStrikes) return {};
    const auto left = std::chrono::ceil<std::chrono::seconds>(found->second.last + duration_ - now);
    if (left.count() > 0) return left;
    entries_.erase(found);
    return {};
}

void Quarantine::strike(const std::string& scene, Clock::time_point now) {
    const std::lock_guard lock(mutex_);
    if (entries_.size() >= kMaxScenes && entries_.count(scene) == 0)
        entries_.erase(std::min_element(
            entries_.begin(), entries_.end(),
            [](const auto& a, const auto& b) { return a.second.last < b.second.last; }));
    Entry& entry = entries_[scene];
    // A strike of long ago says nothing of today.
    if (entry.strikes > 0 && entry.last + duration_ < now) entry.strikes = 0;
    ++entry.strikes;
    entry.last = now;
}

void Quarantine::success(const std::string& scene) {
    const std::lock_guard lock(mutex_);
    entries_.erase(scene);
}

}  // namespace farol::server::worker
