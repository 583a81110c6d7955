#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/store/scene_store.h"

namespace farol::server::store {

/// How often something may be tried.
struct TryLimits {
    int perHour = 1;               ///< 1..kMaxTries within 3,600 s
    int all = 1;                   ///< 1..kMaxTries
    Time forgotten = Time::max();  ///< when the tries may be forgotten
};
inline constexpr int kMaxTries = 1'000;

/// The outcome of a try.
struct Tries {
    bool isGranted = false;
    int left = 0;              ///< of TryLimits::all
    std::optional<Time> next;  ///< when the next one is possible; nothing: never
    bool operator==(const Tries&) const = default;
};
/// Counts a try at `now`, unless a limit is reached. `triesMs`: the times of the tries before, ms
/// since 1970, in their order; a granted one is appended.
Tries takeTry(std::vector<std::int64_t>& triesMs, const TryLimits& limits, Time now);

/// Small documents by table and key: assignments, the codes of their students, submissions. Both
/// names are record names (isRecordName). Thread-safe; each call is atomic, also among services
/// that share the storage. Failed calls throw Busy store.full, store.failed or store.unreachable
/// and change nothing.
class RecordStore {
  public:
    virtual ~RecordStore() = default;

    /// Stores the bytes before it returns; replaces what was there. `expires`: Time::max() never.
    virtual void put(const std::string& table, const std::string& key, const std::string& bytes,
                     Time expires) = 0;
    /// Nothing where there is none, or it has expired or is damaged.
    virtual std::optional<std::string> get(const std::string& table, const std::string& key) = 0;
    /// False where there was none.
    virtual bool remove(const std::string& table, const std::string& key) = 0;
    /// The keys of a table in their order, at most kMaxKeys.
    virtual std::vector<std::string> keys(const std::string& table) = 0;
    /// Removes expired records; returns their number.
    virtual std::size_t expire() = 0;
    /// Counts a try. Here for a storage of one process.
    virtual Tries take(const std::string& table, const std::string& key, const TryLimits& limits);

    /// Removes all records of a table.
    void clear(const std::string& table);

    static constexpr std::size_t kMaxKeys = 10'000;
    static constexpr int kRoomRetryS = 60, kReadRetryS = 5;  ///< of Busy

  private:
    std::mutex taking_;
};

/// Returns whether a text is 1 to 80 of a-z, 0-9, "-" and ".", without a dot in front.
bool isRecordName(const std::string& name);

/// Records that live as long as the process.
class MemoryRecords final : public RecordStore {
  public:
    /// `maxBytes`: of all records together.
    explicit MemoryRecords(std::uint64_t maxBytes) : maxBytes_(maxBytes) {}

    void put(const std::string& table, const std::string& key, const std::string& bytes,
             Time expires) override;
    std::optional<std::string> get(const std::string& table, const std::string& key) override;
    bool remove(const std::string& table, const std::string& key) override;
    std::vector<std::string> keys(const std::string& table) override;
    std::size_t expire() override;

  private:
    struct Record {
        std::string bytes;
        Time expires;
    };
    const std::uint64_t maxBytes_;
    std::mutex mutex_;
    std::map<std::pair<std::string, std::string>, Record> records_;  ///< by table and key
    std::uint64_t bytes_ = 0;
};

}  // namespace farol::server::store
