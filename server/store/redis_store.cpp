#include "server/store/redis_store.h"

#include <algorithm>

#include "server/messages.h"
#include "server/store/redis_scripts.h"
#include "server/store/scene_file.h"
#include "worker/backend.h"

namespace farol::server::store {
namespace {

constexpr int kRetryAfterOutageS = 5;  // time of a restart of Redis
constexpr int kRetryAfterChangeS = 1;
constexpr const char* kAsideS = "604800";  // damaged files are kept for a week
constexpr int kRetryAfterFullS = 60;       // until scenes expire or are removed
constexpr int kMaxRounds = 1'000;          // of expiring, each of at most a thousand scenes

Time timeOfMs(std::int64_t ms) {
    return ms == 0 ? Time::max() : Time(std::chrono::milliseconds(ms));
}

std::string keyOf(const std::string& id) { return std::string(redis::kPrefix) + ":scene:" + id; }

/// {listed, expires in ms or 0, bytes}
Entry entryOf(const std::string& id, const std::vector<RedisReply>& parts, std::size_t from = 0) {
    return {id, parts.at(from).number == 1, timeOfMs(parts.at(from + 1).number),
            static_cast<std::uint64_t>(parts.at(from + 2).number)};
}

/// Returns the value of "name:" in a reply to INFO.
std::string infoOf(const std::string& info, const std::string& name) {
    const std::size_t at = info.find("\n" + name + ":");
    if (at == std::string::npos) return "";
    const std::size_t start = at + name.size() + 2;
    return info.substr(start, info.find_first_of("\r\n", start) - start);
}

}  // namespace

worker::Busy busyUnreachable() { return {message<"store.unreachable">(), kRetryAfterOutageS}; }

worker::Busy busyRefused(const RedisRefusal& why) {
    if (std::string_view(why.what()).starts_with("OOM"))
        return {message<"store.full">(), kRetryAfterFullS};
    return {message<"store.failed">(), kRetryAfterFullS};
}

RedisStore::RedisStore(RedisAddress address, StoreLimits limits, Log log,
                       std::chrono::microseconds usePause)
    : limits_(limits),
      log_(log),
      usePause_(std::to_string(usePause.count())),
      link_(std::move(address), std::move(log)) {
    inspectServer();
}

/// Warns the operator at the start of settings of Redis that may lose scenes.
void RedisStore::inspectServer() {
    try {
        const std::string info = link_.ask({"INFO"}).text;
        log_("Redis " + infoOf(info, "redis_version") + ", " + std::to_string(bytes()) +
             " bytes of scenes");
        const auto setting = link_.ask({"CONFIG", "GET", "appendfsync"}).parts;
        if (infoOf(info, "aof_enabled") != "1" || setting.size() != 2 ||
            setting[1].text != "always")
            log_(
                "Redis does not write each change to its disk (appendonly yes, appendfsync "
                "always): if it is killed, acknowledged scenes may be lost");
        const std::string policy = infoOf(info, "maxmemory_policy");
        if (!policy.empty() && policy != "noeviction")
            log_("Redis may drop scenes by itself: its maxmemory-policy is " + policy);
    } catch (const RedisAway&) {
        // The link has logged it.
    } catch (const RedisRefusal& why) {
        log_(std::string("Redis does not say how it keeps its data: ") + why.what());
    }
}

RedisReply RedisStore::run(const char* script, const std::vector<std::string>& arguments) const {
    const std::string text = std::string(redis::kCommon) + script;
    std::vector<std::string_view> words = {"EVAL", text, "1", redis::kPrefix};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return link_.ask(words);
}

RedisReply RedisStore::required(const char* script,
                                const std::vector<std::string>& arguments) const {
    try {
        return run(script, arguments);
    } catch (const RedisAway&) {
        throw busyUnreachable();
    } catch (const RedisRefusal& why) {
        log_(std::string("Redis refuses: ") + why.what());
        throw busyRefused(why);
    }
}

SceneStore::Put RedisStore::put(const scene::Bundle& bundle, bool listed) {
    Stored scene;
    scene.entry.id = idOf(bundle);
    scene.entry.expires = Time::max();
    scene.bundle = std::make_shared<const scene::Bundle>(bundle);
    // Mutable facts are stored beside the file, which is the same for all uploads.
    const std::string file = encodeScene(scene);
    refuseLargerThan(limits_, file.size());
    const auto expireMs = std::chrono::milliseconds(limits_.expire).count();
    const RedisReply reply =
        required(redis::kPut, {scene.entry.id, file, listed ? "1" : "0", std::to_string(expireMs),
                               std::to_string(limits_.bytes), std::to_string(limits_.scenes)});
    scene.entry = entryOf(scene.entry.id, reply.parts, 1);
    return {scene.entry, reply.parts.at(0).number == 1};
}

std::optional<Stored> RedisStore::get(const std::string& id) {
    if (!isStoredId(id)) return std::nullopt;
    Stored scene;
    {
        const std::lock_guard lock(mutex_);
        if (const Stored* kept = cache_.find(id)) scene = *kept;
    }
    try {
        const RedisReply reply = run(redis::kTouch, {id, usePause_});
        if (reply.parts.empty()) return std::nullopt;
        scene.entry = entryOf(id, reply.parts);
        if (!scene.bundle) {
            const RedisReply file = link_.ask({"GET", keyOf(id)});
            if (file.isNil) return std::nullopt;  // expired in between
            auto read = decodeScene(file.text);
            if (!read || read->entry.id != id) {
                if (run(redis::kSetAside, {id, file.text, kAsideS}).number == 0)
                    throw worker::Busy(message<"store.failed/change">(), kRetryAfterChangeS);
                log_(id + " is damaged and set aside");
                return std::nullopt;
            }
            scene.bundle = std::move(read->bundle);
        }
    } catch (const RedisAway&) {
        // A scene is its content's digest: this copy is right, even if it was deleted elsewhere.
        if (scene.bundle && scene.entry.expires > now()) return scene;
        throw busyUnreachable();
    } catch (const RedisRefusal& why) {
        log_(std::string("Redis refuses: ") + why.what());
        throw busyRefused(why);
    }
    const std::lock_guard lock(mutex_);
    if (Stored* kept = cache_.find(id))
        kept->entry = scene.entry;
    else
        cache_.put(id, scene, scene.bundle->bytes());
    return scene;
}

bool RedisStore::remove(const std::string& id) {
    return required(redis::kRemove, {id}).number == 1;
}

std::vector<Entry> RedisStore::list() {
    std::vector<Entry> all;
    for (const RedisReply& one : required(redis::kList, {}).parts)
        all.push_back(entryOf(one.parts.at(0).text, one.parts, 1));
    std::sort(all.begin(), all.end(), [](const Entry& a, const Entry& b) { return a.id < b.id; });
    return all;
}

std::size_t RedisStore::expire() {
    std::size_t gone = 0;
    try {
        for (int round = 0; round < kMaxRounds; ++round) {
            const auto now = static_cast<std::size_t>(run(redis::kExpire, {}).number);
            gone += now;
            if (now == 0) break;
        }
    } catch (const RedisAway&) {
        // The next sweep, or another service's, does it.
    } catch (const RedisRefusal& why) {
        log_(std::string("Redis refuses: ") + why.what());
    }
    return gone;
}

std::uint64_t RedisStore::bytes() const {
    try {
        return static_cast<std::uint64_t>(run(redis::kBytes, {}).number);
    } catch (const std::runtime_error&) {
        return 0;
    }
}

}  // namespace farol::server::store
