#include "server/store/record_store.h"

#include <algorithm>

#include "core/number.h"
#include "core/text.h"
#include "server/messages.h"
#include "worker/backend.h"

namespace farol::server::store {
namespace {

constexpr std::size_t kMaxRecordName = 80;
constexpr std::chrono::milliseconds kTryWindow = std::chrono::hours(1);

std::int64_t millisecondsOf(Time time) {
    return std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count();
}

}  // namespace

bool isRecordName(const std::string& name) {
    return !name.empty() && name.size() <= kMaxRecordName && name.front() != '.' &&
           std::all_of(name.begin(), name.end(), [](char c) {
               return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '.';
           });
}

Tries takeTry(std::vector<std::int64_t>& triesMs, const TryLimits& limits, Time now) {
    const int all = std::clamp(limits.all, 1, kMaxTries);
    const int perHour = std::clamp(limits.perHour, 1, kMaxTries);
    const auto count = [&] { return static_cast<int>(triesMs.size()); };
    // The oldest of the last `perHour` tries decides when the next one is possible.
    const auto next = [&] {
        if (count() < perHour) return now;
        const std::int64_t oldestMs = triesMs[static_cast<std::size_t>(count() - perHour)];
        return std::max(now, Time(std::chrono::milliseconds(oldestMs) + kTryWindow));
    };
    Tries out;
    if (count() >= all) return out;
    if (next() <= now) {
        triesMs.push_back(millisecondsOf(now));
        out.isGranted = true;
    }
    out.left = all - count();
    if (out.left > 0) out.next = next();
    return out;
}

void RecordStore::clear(const std::string& table) {
    for (auto names = keys(table); !names.empty(); names = keys(table))
        for (const std::string& key : names) remove(table, key);
}

Tries RecordStore::take(const std::string& table, const std::string& key, const TryLimits& limits) {
    const std::lock_guard lock(taking_);
    const std::string before = get(table, key).value_or("");
    std::vector<std::int64_t> triesMs;
    for (const std::string_view word : split(before))
        triesMs.push_back(parseExact<std::int64_t>(word).value_or(0));
    const Tries out = takeTry(triesMs, limits, now());
    if (out.isGranted)
        put(table, key, before + " " + std::to_string(triesMs.back()), limits.forgotten);
    return out;
}

void MemoryRecords::put(const std::string& table, const std::string& key, const std::string& bytes,
                        Time expires) {
    const std::lock_guard lock(mutex_);
    const auto known = records_.find({table, key});
    const std::uint64_t before = known == records_.end() ? 0 : known->second.bytes.size();
    if (bytes_ - before + bytes.size() > maxBytes_)
        throw worker::Busy(message<"store.full">(), kRoomRetryS);
    records_[{table, key}] = {bytes, expires};
    bytes_ += bytes.size() - before;
}

std::optional<std::string> MemoryRecords::get(const std::string& table, const std::string& key) {
    const std::lock_guard lock(mutex_);
    const auto known = records_.find({table, key});
    if (known == records_.end() || known->second.expires <= now()) return std::nullopt;
    return known->second.bytes;
}

bool MemoryRecords::remove(const std::string& table, const std::string& key) {
    const std::lock_guard lock(mutex_);
    const auto known = records_.find({table, key});
    if (known == records_.end()) return false;
    bytes_ -= known->second.bytes.size();
    records_.erase(known);
    return true;
}

std::vector<std::string> MemoryRecords::keys(const std::string& table) {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> out;
    for (auto at = records_.lower_bound({table, ""});
         at != records_.end() && at->first.first == table && out.size() < kMaxKeys; ++at)
        out.push_back(at->first.second);
    return out;
}

std::size_t MemoryRecords::expire() {
    const std::lock_guard lock(mutex_);
    return std::erase_if(records_, [this](const auto& one) {
        const bool isOver = one.second.expires <= now();
        if (isOver) bytes_ -= one.second.bytes.size();
        return isOver;
    });
}

}  // namespace farol::server::store
