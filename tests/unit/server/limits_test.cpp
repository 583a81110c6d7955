#include <catch2/catch.hpp>

#include "server/picture_cache.h"
#include "server/rate_limiter.h"
#include "worker/backend.h"

using namespace farol;
using namespace farol::server;
using namespace std::chrono_literals;

namespace {

http::Request from(const std::string& address, const std::string& forwarded = "") {
    http::Request request;
    request.remoteAddress = address;
    if (!forwarded.empty()) request.headers.emplace_back("x-forwarded-for", forwarded);
    return request;
}

int retryAfter(RateLimiter& limiter, const std::string& client, RateLimiter::Clock::time_point at) {
    try {
        limiter.admit(client, at);
        return 0;
    } catch (const worker::Busy& busy) {
        CHECK(busy.code() == "limit.rate");
        return busy.retryAfterS();
    }
}

http::Response picture(std::size_t bytes, char fill) {
    http::Response response;
    response.body.assign(bytes, fill);
    response.set("Server-Timing", "draw;dur=9");
    response.set("X-Farol-Stats", "{}");
    return response;
}

}  // namespace

TEST_CASE("a client gets its burst, then its rate, and its neighbour is not touched") {
    RateLimiter limiter({2.0, 3, false});
    const RateLimiter::Clock::time_point start{};
    for (int i = 0; i < 3; ++i) CHECK(retryAfter(limiter, "a", start) == 0);
    CHECK(retryAfter(limiter, "a", start) == 1);
    CHECK(retryAfter(limiter, "b", start) == 0);
    CHECK(retryAfter(limiter, "a", start + 500ms) == 0);
    CHECK(retryAfter(limiter, "a", start + 600ms) == 1);
    // A long pause gives the burst back, not more.
    for (int i = 0; i < 3; ++i) CHECK(retryAfter(limiter, "a", start + 1h) == 0);
    CHECK(retryAfter(limiter, "a", start + 1h) == 1);
}

TEST_CASE("a slow rate says how long to wait") {
    RateLimiter limiter({0.1, 1, false});
    const RateLimiter::Clock::time_point start{};
    CHECK(retryAfter(limiter, "a", start) == 0);
    CHECK(retryAfter(limiter, "a", start) == 10);
    CHECK(retryAfter(limiter, "a", start + 4s) == 6);
}

TEST_CASE("a client is its socket's peer unless our own proxy speaks for it") {
    CHECK(clientOf(from("10.0.0.1"), false) == "10.0.0.1");
    CHECK(clientOf(from("10.0.0.1", "1.2.3.4"), false) == "10.0.0.1");
    // Addresses before the last were written by the client itself.
    CHECK(clientOf(from("10.0.0.1", "6.6.6.6, 1.2.3.4"), true) == "1.2.3.4");
    CHECK(clientOf(from("10.0.0.1"), true) == "10.0.0.1");
    CHECK(clientOf(from("2001:db8:1:2:3:4:5:6"), false) == "2001:db8:1:2::");
    CHECK(clientOf(from("2001:db8:1:2::9"), false) == "2001:db8:1:2::");
    CHECK(clientOf(from("::ffff:1.2.3.4"), false) != clientOf(from("::ffff:1.2.3.5"), false));
}

TEST_CASE("pictures are kept within their bytes, the least used go first") {
    PictureCache cache(100'000);
    cache.put("a", picture(20'000, 'a'));
    cache.put("b", picture(20'000, 'b'));
    cache.put("c", picture(20'000, 'c'));
    REQUIRE(cache.find("a"));
    for (const char* tag : {"d", "e"}) cache.put(tag, picture(20'000, 'x'));
    CHECK(cache.find("a"));
    CHECK_FALSE(cache.find("b"));
    CHECK(*cache.find("e")->shared == std::string(20'000, 'x'));
    cache.put("big", picture(90'000, 'y'));  // it would sweep out all others
    CHECK_FALSE(cache.find("big"));
    CHECK(cache.find("a"));
    CHECK(cache.counts().hits == 4);
    CHECK(cache.counts().misses == 2);
}

TEST_CASE("a kept picture does not tell another picture's times") {
    PictureCache cache(1 << 20);
    cache.put("a", picture(10, 'a'));
    const auto found = cache.find("a");
    REQUIRE(found);
    std::string timing, stats;
    for (const auto& [name, value] : found->headers) {
        if (name == "Server-Timing") timing += value;
        if (name == "X-Farol-Stats") stats += value;
    }
    CHECK(timing == "cache;desc=hit");
    CHECK(stats == "{}");
}

TEST_CASE("a cache of no bytes keeps nothing") {
    PictureCache cache(0);
    cache.put("a", picture(0, 'a'));
    CHECK_FALSE(cache.find("a"));
}
