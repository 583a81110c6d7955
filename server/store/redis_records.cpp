#include "server/store/redis_records.h"

#include <algorithm>

#include "core/number.h"
#include "server/messages.h"
#include "server/secret.h"
#include "server/store/redis_scripts.h"
#include "server/store/redis_store.h"
#include "worker/backend.h"

namespace farol::server::store {
namespace {

constexpr int kMaxSweeps = 1'000;  // of expiring, each of at most a thousand records

std::string nameOf(const std::string& table, const std::string& key) { return table + "/" + key; }

std::string endText(Time time) {
    if (time == Time::max()) return "0";
    return std::to_string(
        std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count());
}

}  // namespace

RedisRecords::RedisRecords(RedisAddress address, std::uint64_t maxBytes, Log log)
    : maxBytes_(std::to_string(maxBytes)), log_(log), link_(std::move(address), std::move(log)) {}

RedisReply RedisRecords::run(const char* script, const std::vector<std::string>& arguments) {
    const std::string text = std::string(redis::kCommon) + redis::kRecords + script;
    std::vector<std::string_view> words = {"EVAL", text, "1", redis::kPrefix};
    words.insert(words.end(), arguments.begin(), arguments.end());
    try {
        return link_.ask(words);
    } catch (const RedisAway&) {
        throw busyUnreachable();
    } catch (const RedisRefusal& why) {
        log_(std::string("Redis refuses: ") + why.what());
        throw busyRefused(why);
    }
}

void RedisRecords::put(const std::string& table, const std::string& key, const std::string& bytes,
                       Time expires) {
    if (run(redis::kPutRecord, {nameOf(table, key), bytes, endText(expires), maxBytes_}).number ==
        0)
        throw worker::Busy(message<"store.full">(), kRoomRetryS);
}

std::optional<std::string> RedisRecords::get(const std::string& table, const std::string& key) {
    RedisReply reply = run(redis::kGetRecord, {nameOf(table, key)});
    if (reply.isNil) return std::nullopt;
    return std::move(reply.text);
}

bool RedisRecords::remove(const std::string& table, const std::string& key) {
    return run(redis::kRemoveRecord, {nameOf(table, key)}).number == 1;
}

std::vector<std::string> RedisRecords::keys(const std::string& table) {
    std::vector<std::string> out;
    for (RedisReply& key : run(redis::kRecordKeys, {table}).parts)
        out.push_back(std::move(key.text));
    std::sort(out.begin(), out.end());
    if (out.size() > kMaxKeys) out.resize(kMaxKeys);
    return out;
}

std::size_t RedisRecords::expire() {
    std::size_t gone = 0;
    try {
        for (int round = 0; round < kMaxSweeps; ++round) {
            const auto now = static_cast<std::size_t>(run(redis::kExpireRecords, {}).number);
            gone += now;
            if (now == 0) break;
        }
    } catch (const worker::Busy&) {
        // The next sweep, or another service's, does it.
    }
    return gone;
}

Tries RedisRecords::take(const std::string& table, const std::string& key,
                         const TryLimits& limits) {
    const RedisReply reply =
        run(redis::kTake,
            {nameOf(table, key), randomSecret(),
             std::to_string(std::clamp(limits.perHour, 1, kMaxTries)),
             std::to_string(std::clamp(limits.all, 1, kMaxTries)), endText(limits.forgotten)});
    Tries out;
    out.isGranted = reply.parts.at(0).number == 1;
    out.left = static_cast<int>(reply.parts.at(1).number);
    if (const std::int64_t next = reply.parts.at(2).number; next > 0)
        out.next = Time(std::chrono::milliseconds(next));
    return out;
}

}  // namespace farol::server::store
