#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

struct redisContext;

/// Wraps hiredis; no other code uses it.
namespace farol::server::store {

/// Where a Redis is: redis://[user:password@]host[:port][/database].
struct RedisAddress {
    std::string host;
    int port = 6379;
    std::string user, password;  ///< empty: none
    int database = 0;
    /// Without the password, for logs.
    std::string shown() const;
};

/// Throws Error option.syntax, which never repeats the password.
RedisAddress redisAddressOf(const std::string& url);

/// A reply of Redis, without its library's types.
struct RedisReply {
    bool isNil = false;
    std::int64_t number = 0;
    std::string text;
    std::vector<RedisReply> parts;
};

/// An error reply of Redis: "OOM command not allowed ...".
class RedisRefusal : public std::runtime_error {
    using std::runtime_error::runtime_error;
};
/// Redis is unreachable.
class RedisAway : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Sends commands to one Redis. Thread-safe. Opens connections on demand, keeps them for later
/// commands, and closes them on failure. A failed command is retried once on a new connection, so
/// all commands must be idempotent. After a failure, makes no attempt for `kPause`: an unreachable
/// Redis costs its callers no time.
class RedisLink {
  public:
    using Log = std::function<void(const std::string&)>;
    RedisLink(RedisAddress address, Log log);
    ~RedisLink();
    RedisLink(const RedisLink&) = delete;
    RedisLink& operator=(const RedisLink&) = delete;

    /// Throws RedisAway or RedisRefusal.
    RedisReply ask(const std::vector<std::string_view>& words);
    /// Whether the last command reached Redis.
    bool isUp() const;

    static constexpr std::chrono::milliseconds kConnect{1'000}, kAnswer{5'000}, kPause{1'000};

  private:
    using Clock = std::chrono::steady_clock;
    struct Close {
        void operator()(redisContext* context) const;
    };
    using Connection = std::unique_ptr<redisContext, Close>;

    Connection take();
    Connection connect() const;
    void give(Connection connection);
    void note(const std::string& fault, Clock::time_point failedAt = {});

    const RedisAddress address_;
    const Log log_;
    mutable std::mutex mutex_;
    std::vector<Connection> free_;
    Clock::time_point notBefore_{};
    bool up_ = true;
};

}  // namespace farol::server::store
