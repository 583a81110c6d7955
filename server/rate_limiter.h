#pragma once

#include <chrono>
#include <mutex>
#include <string>

#include "core/lru_cache.h"
#include "server/http/message.h"

namespace farol::server {

struct RateLimit {
    double perSecond = 0;     ///< requests of one client; 0: no limit
    int burst = 0;            ///< at once, after a pause; 0: two seconds' worth, at least 20
    bool trustProxy = false;  ///< the client is the last address of X-Forwarded-For
};

/// Returns the client that a request counts for: the peer's address, or the proxy's peer; the first
/// 64 bits of an IPv6 address, since one client usually has the whole /64.
std::string clientOf(const http::Request& request, bool trustProxy);

/// A token bucket for each client. Keeps the 10,000 most recent clients. Thread-safe.
class RateLimiter {
  public:
    using Clock = std::chrono::steady_clock;
    explicit RateLimiter(RateLimit limit);

    /// Takes one token of the client. Throws Busy limit.rate with the seconds after which the next
    /// request is accepted.
    void admit(const std::string& client, Clock::time_point now = Clock::now());
    bool isOn() const { return limit_.perSecond > 0; }

  private:
    struct Bucket {
        double tokens;
        Clock::time_point at;
    };
    RateLimit limit_;
    std::mutex mutex_;
    LruCache<std::string, Bucket> buckets_;
};

}  // namespace farol::server
