#include "worker/quarantine.h"

#include <algorithm>

namespace farol::worker {

template <typename Entry>
std::chrono::seconds Quarantine::left(const Entry& entry, Clock::time_point now) const {
    return std::max(std::chrono::seconds(0),
                    std::chrono::ceil<std::chrono::seconds>(entry.last + duration_ - now));
}

Quarantine::Closed Quarantine::closed(const JobIdentity& job, Clock::time_point now) {
    const std::lock_guard lock(mutex_);
    if (const auto found = scenes_.find(job.scene);
        found != scenes_.end() && found->second.requests.size() >= kSceneStrikes) {
        if (const auto rest = left(found->second, now); rest.count() > 0) return {rest, true};
        scenes_.erase(found);
    }
    if (const auto found = requests_.find(job.request);
        found != requests_.end() && found->second.strikes >= kRequestStrikes) {
        if (const auto rest = left(found->second, now); rest.count() > 0) return {rest, false};
        requests_.erase(found);
    }
    return {};
}

/// Returns the entry of a key; adds it if necessary, and evicts the oldest if full. Clears strikes
/// that are older than the quarantine's duration.
template <typename Entry>
Entry& Quarantine::entryOf(std::map<std::string, Entry>& entries, const std::string& key,
                           Clock::time_point now) {
    if (entries.size() >= kMaxEntries && entries.count(key) == 0)
        entries.erase(std::min_element(
            entries.begin(), entries.end(),
            [](const auto& a, const auto& b) { return a.second.last < b.second.last; }));
    Entry& entry = entries[key];
    if (left(entry, now).count() == 0) entry = {};
    entry.last = now;
    return entry;
}

void Quarantine::strike(const JobIdentity& job, Cause cause, Clock::time_point now) {
    if (job.request.empty()) return;
    const std::lock_guard lock(mutex_);
    ++entryOf(requests_, job.request, now).strikes;
    if (cause != Cause::crash || job.scene.empty()) return;
    Scene& scene = entryOf(scenes_, job.scene, now);
    if (scene.requests.size() < kSceneStrikes) scene.requests.insert(job.request);
}

void Quarantine::success(const JobIdentity& job) {
    const std::lock_guard lock(mutex_);
    requests_.erase(job.request);
    const auto scene = scenes_.find(job.scene);
    if (scene == scenes_.end()) return;
    scene->second.requests.erase(job.request);
    if (scene->second.requests.empty()) scenes_.erase(scene);
}

}  // namespace farol::worker
