#include "server/rate_limiter.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "server/backend.h"

namespace farol::server {
namespace {

constexpr std::size_t kMaxClients = 10'000;
constexpr int kLeastBurst = 20;  // a page opens with a screenful of thumbnails

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

std::string clientOf(const http::Request& request, bool trustProxy) {
    std::string address = request.remoteAddress;
    if (const auto forwarded = request.header("x-forwarded-for"); trustProxy && forwarded)
        address = trimmed(forwarded->substr(forwarded->rfind(',') + 1));
    std::array<unsigned char, 16> bytes{};
    if (inet_pton(AF_INET6, address.c_str(), bytes.data()) != 1) return address;
    // ::ffff:a.b.c.d is an IPv4 client on a socket for both.
    static constexpr std::array<unsigned char, 12> kMapped = {0, 0, 0, 0, 0,    0,
                                                              0, 0, 0, 0, 0xFF, 0xFF};
    if (!std::equal(kMapped.begin(), kMapped.end(), bytes.begin()))
        std::fill(bytes.begin() + 8, bytes.end(), static_cast<unsigned char>(0));
    std::array<char, INET6_ADDRSTRLEN> text{};
    inet_ntop(AF_INET6, bytes.data(), text.data(), text.size());
    return text.data();
}

RateLimiter::RateLimiter(RateLimit limit) : limit_(limit), buckets_(kMaxClients) {
    if (limit_.burst == 0)
        limit_.burst = std::max(kLeastBurst, static_cast<int>(std::ceil(2 * limit_.perSecond)));
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
        throw Busy("limit.rate", "This client sends more requests than it may.",
                   std::max(1, static_cast<int>(std::ceil(seconds))));
    }
    bucket->tokens -= 1.0;
}

}  // namespace farol::server
