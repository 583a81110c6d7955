#include "server/store/redis_link.h"

#include <hiredis/hiredis.h>

#include <algorithm>
#include <utility>

#include "core/error.h"
#include "core/number.h"
#include "server/http/uri.h"
#include "server/messages.h"

namespace farol::server::store {
namespace {

constexpr std::size_t kMaxFreeConnections = 16;  // idle connections that are kept
constexpr const char* kPausing = "it was not there a moment ago";

[[noreturn]] void refuseUrl(const std::string& why) {
    throw Error(message<"option.syntax/store">("reason"_arg = uncut(why)), {}, "store");
}

int numberIn(std::string_view text, int min, int max, const char* name) {
    const auto number = parseExact<int>(text);
    if (!number || *number < min || *number > max)
        refuseUrl(std::string("the ") + name + " must be in " + std::to_string(min) + " to " +
                  std::to_string(max));
    return *number;
}

std::string decoded(std::string_view text) {
    auto plain = http::percentDecode(text, false);
    if (!plain) refuseUrl("the name or the password is not percent-encoded");
    return std::move(*plain);
}

timeval timevalOf(std::chrono::milliseconds time) {
    return {time.count() / 1000, time.count() % 1000 * 1000};
}

RedisReply converted(const redisReply& from) {
    RedisReply to;
    to.isNil = from.type == REDIS_REPLY_NIL;
    if (from.type == REDIS_REPLY_INTEGER) to.number = from.integer;
    if (from.str != nullptr) to.text.assign(from.str, from.len);
    for (std::size_t i = 0; i < from.elements; ++i) to.parts.push_back(converted(*from.element[i]));
    return to;
}

struct Free {
    void operator()(redisReply* reply) const { freeReplyObject(reply); }
};
using Reply = std::unique_ptr<redisReply, Free>;

Reply send(redisContext& context, const std::vector<std::string_view>& words) {
    std::vector<const char*> starts;
    std::vector<std::size_t> sizes;
    for (const std::string_view word : words) {
        starts.push_back(word.data());
        sizes.push_back(word.size());
    }
    return Reply(static_cast<redisReply*>(
        redisCommandArgv(&context, static_cast<int>(words.size()), starts.data(), sizes.data())));
}

/// True for errors of a Redis that is temporarily unable: loading data, a replica, a busy script.
bool isPassing(std::string_view refusal) {
    for (const char* start : {"LOADING", "READONLY", "MASTERDOWN", "BUSY", "TRYAGAIN"})
        if (refusal.starts_with(start)) return true;
    return false;
}

}  // namespace

std::string RedisAddress::shown() const {
    const bool v6 = host.find(':') != std::string::npos;
    return "redis://" + (v6 ? "[" + host + "]" : host) + ":" + std::to_string(port) + "/" +
           std::to_string(database);
}

RedisAddress redisAddressOf(const std::string& url) {
    constexpr std::string_view kScheme = "redis://";
    if (!url.starts_with(kScheme)) refuseUrl("it does not begin with redis://");
    std::string_view rest = std::string_view(url).substr(kScheme.size());
    RedisAddress address;
    if (const std::size_t slash = rest.find('/'); slash != std::string_view::npos) {
        if (slash + 1 < rest.size())
            address.database = numberIn(rest.substr(slash + 1), 0, 1'000'000, "database");
        rest = rest.substr(0, slash);
    }
    if (const std::size_t at = rest.rfind('@'); at != std::string_view::npos) {
        const std::string_view who = rest.substr(0, at);
        const std::size_t colon = who.find(':');
        if (colon == std::string_view::npos) refuseUrl("the password is missing");
        address.user = decoded(who.substr(0, colon));
        address.password = decoded(who.substr(colon + 1));
        rest = rest.substr(at + 1);
    }
    if (rest.starts_with('[')) {
        const std::size_t end = rest.find(']');
        if (end == std::string_view::npos) refuseUrl("the ] of the address is missing");
        address.host = rest.substr(1, end - 1);
        rest = rest.substr(end + 1);
    } else {
        address.host = rest.substr(0, rest.find(':'));
        rest = rest.substr(address.host.size());
    }
    if (address.host.empty()) refuseUrl("the host is missing");
    if (!rest.empty() && rest.front() != ':') refuseUrl("the port is not written as :6379");
    if (!rest.empty()) address.port = numberIn(rest.substr(1), 1, 65'535, "port");
    return address;
}

void RedisLink::Close::operator()(redisContext* context) const { redisFree(context); }

RedisLink::RedisLink(RedisAddress address, Log log)
    : address_(std::move(address)), log_(std::move(log)) {}

RedisLink::~RedisLink() = default;

bool RedisLink::isUp() const {
    const std::lock_guard lock(mutex_);
    return up_;
}

RedisLink::Connection RedisLink::connect() const {
    Connection made(
        redisConnectWithTimeout(address_.host.c_str(), address_.port, timevalOf(kConnect)));
    if (!made) throw std::bad_alloc();
    if (made->err != 0) throw RedisAway(made->errstr);
    redisSetTimeout(made.get(), timevalOf(kAnswer));
    redisEnableKeepAlive(made.get());
    const auto greet = [&](const std::vector<std::string_view>& words) {
        const Reply reply = send(*made, words);
        if (!reply) throw RedisAway(made->errstr);
        if (reply->type == REDIS_REPLY_ERROR)
            throw RedisAway(std::string(reply->str, reply->len));  // the operator must fix it
    };
    if (!address_.user.empty())
        greet({"AUTH", address_.user, address_.password});
    else if (!address_.password.empty())
        greet({"AUTH", address_.password});
    if (address_.database != 0) greet({"SELECT", std::to_string(address_.database)});
    return made;
}

RedisLink::Connection RedisLink::take() {
    {
        const std::lock_guard lock(mutex_);
        if (!free_.empty()) {
            Connection one = std::move(free_.back());
            free_.pop_back();
            return one;
        }
        if (Clock::now() < notBefore_) throw RedisAway(kPausing);
    }
    return connect();
}

void RedisLink::give(Connection connection) {
    const std::lock_guard lock(mutex_);
    if (free_.size() < kMaxFreeConnections) free_.push_back(std::move(connection));
}

/// Logs each change of the state once. An empty `fault`: reachable.
void RedisLink::note(const std::string& fault, Clock::time_point failedAt) {
    {
        const std::lock_guard lock(mutex_);
        const bool was = std::exchange(up_, fault.empty());
        if (!up_) {
            free_.clear();
            // A call within the pause made no attempt, and must not extend the pause.
            notBefore_ = std::max(notBefore_, failedAt + kPause);
        }
        if (was == up_) return;
    }
    log_(address_.shown() + (fault.empty() ? " is there again" : " cannot be asked: " + fault));
}

RedisReply RedisLink::ask(const std::vector<std::string_view>& words) {
    std::string fault;
    // The first connection may be dead after a restart of Redis.
    for (int attempt = 0; attempt < 2; ++attempt) {
        Connection connection;
        try {
            connection = take();
        } catch (const RedisAway& away) {
            fault = away.what();
            break;
        }
        const Reply reply = send(*connection, words);
        if (!reply) {
            fault = connection->errstr;
            const std::lock_guard lock(mutex_);
            free_.clear();  // they are likely dead, too
            continue;
        }
        const bool refused = reply->type == REDIS_REPLY_ERROR;
        const std::string text = refused ? std::string(reply->str, reply->len) : std::string();
        if (refused && isPassing(text)) {
            fault = text;
            break;
        }
        give(std::move(connection));
        note("");
        if (refused) throw RedisRefusal(text);
        return converted(*reply);
    }
    note(fault, fault == kPausing ? Clock::time_point() : Clock::now());
    throw RedisAway(fault);
}

}  // namespace farol::server::store
