#include "server/rate_limiter.h"

#include <algorithm>
#include <cmath>

#include "core/text.h"
#include "server/http/authority.h"
#include "server/messages.h"
#include "worker/backend.h"

namespace farol::server {
namespace {

constexpr std::size_t kMaxClients = 10'000;
constexpr std::size_t kMaxAddress = 64;  // of a key: a proxy may pass on any text
constexpr int kMinBurst = 20;            // a page opens with a screenful of thumbnails

}  // namespace

std::string clientOf(const http::Request& request, bool trustProxy) {
    std::string address = request.remoteAddress;
    if (const auto forwarded = request.header("x-forwarded-for"); trustProxy && forwarded)
        address =
            trimmed(std::string_view(*forwarded).substr(forwarded->rfind(',') + 1), kLineBlanks)
                .substr(0, kMaxAddress);
    return http::clientOfAddress(address);
}

RateLimiter::RateLimiter(RateLimit limit) : limit_(limit), buckets_(kMaxClients) {
    if (limit_.burst == 0)
        limit_.burst = std::max(kMinBurst, static_cast<int>(std::ceil(2 * limit_.perSecond)));
}

void RateLimiter::admit(const std::string& client, Clock::time_point now) {
    if (!isOn()) return;
    const std::lock_guard lock(mutex_);
    Bucket* bucket = buckets_.find(client);
    if (bucket == nullptr)
        bucket = &buckets_.put(client, {static_cast<double>(limit_.burst), now}, 1);
    const double passed = std::chrono::duration<double>(now - bucket->at).count();
    bucket->tokens = std::min<double>(limit_.burst, bucket->tokens + passed * limit_.perSecond);
    bucket->at = now;
    if (bucket->tokens < 1.0) {
        const double seconds = (1.0 - bucket->tokens) / limit_.perSecond;
        const int waitS = std::max(1, static_cast<int>(std::ceil(seconds)));
        throw worker::Busy(message<"limit.rate">("seconds"_arg = waitS), waitS);
    }
    bucket->tokens -= 1.0;
}

}  // namespace farol::server
