// The store that many services share, against a real Redis: the guarantees of the other stores, and
// a Redis that cannot be reached.
#include "server/store/redis_store.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "core/error.h"
#include "redis_server.h"
#include "worker/backend.h"

using namespace farol;
using namespace farol::server;
using namespace farol::server::store;
using farol::test::RedisServer;

namespace {

scene::Bundle bundleOf(const std::string& text, std::size_t bytes = 0) {
    return {"scene.xml", {{"scene.xml", text}, {"t/a.png", std::string(bytes, 'x')}}};
}

RedisStore open(const RedisServer& redis, StoreLimits limits = {}) {
    return RedisStore(
        redis.address(), limits, [](const std::string&) {}, std::chrono::microseconds(0));
}

template <typename Call>
std::string codeOf(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.code();
    } catch (const worker::Busy& busy) {
        CHECK(busy.retryAfterS() > 0);
        return busy.code();
    }
    return "none";
}

}  // namespace

TEST_CASE("addresses of a Redis are read, and refused without their password") {
    const auto full = redisAddressOf("redis://me:p%40ss%3A@[::1]:7000/3");
    CHECK(full.host == "::1");
    CHECK(full.port == 7000);
    CHECK(full.user == "me");
    CHECK(full.password == "p@ss:");
    CHECK(full.database == 3);
    CHECK(full.shown() == "redis://[::1]:7000/3");
    const auto plain = redisAddressOf("redis://store");
    CHECK(plain.host == "store");
    CHECK(plain.port == 6379);
    CHECK(plain.database == 0);
    CHECK(redisAddressOf("redis://:secret@store/").password == "secret");
    for (const char* url :
         {"", "store", "http://store", "redis://", "redis://:6379", "redis://store:0",
          "redis://store:65536", "redis://store:6379x", "redis://store/x", "redis://store/-1",
          "redis://secret@store", "redis://[::1", "redis://[::1]6379", "redis://me:%zz@store"}) {
        INFO(url);
        CHECK(codeOf([&] { redisAddressOf(url); }) == "option.syntax");
    }
    try {
        redisAddressOf("redis://me:secret@store:99999");
        FAIL("it was accepted");
    } catch (const Error& error) {
        CHECK(std::string(error.what()).find("secret") == std::string::npos);
    }
}

TEST_CASE("a scene that one service puts into Redis is found by all") {
    const RedisServer redis;
    RedisStore one = open(redis), other = open(redis);
    const scene::Bundle bundle = bundleOf("<world/>", 1000);
    const SceneStore::Put first = one.put(bundle, false);
    CHECK(first.created);
    CHECK(first.entry.id == idOf(bundle));
    CHECK(other.list().empty());
    const auto found = other.get(first.entry.id);
    REQUIRE(found);
    CHECK(found->bundle->files == bundle.files);
    CHECK(found->bundle->main == "scene.xml");
    CHECK(found->entry == first.entry);

    const SceneStore::Put again = other.put(bundle, true);
    CHECK_FALSE(again.created);
    CHECK(again.entry.bytes == first.entry.bytes);
    CHECK(again.entry.expires >= first.entry.expires);
    REQUIRE(one.list().size() == 1);
    CHECK(one.list()[0] == again.entry);
    CHECK(one.put(bundle, false).entry.listed);  // once listed, listed

    const SceneStore::Put second = one.put(bundleOf("<world>2</world>"), false);
    CHECK(one.bytes() == first.entry.bytes + second.entry.bytes);
    CHECK(other.remove(first.entry.id));
    CHECK_FALSE(one.remove(first.entry.id));
    for (RedisStore* store : {&one, &other}) {
        CHECK_FALSE(store->get(first.entry.id));  // though both have its files in memory
        CHECK(store->get(second.entry.id));
        CHECK(store->list().empty());
    }
    CHECK(one.bytes() == second.entry.bytes);
    CHECK_FALSE(one.get("~00000000000000000000000000000000"));
    CHECK_FALSE(one.get("../etc/passwd"));
}

TEST_CASE("a full Redis store evicts the least recently used scenes") {
    const RedisServer redis;
    StoreLimits limits;
    limits.bytes = 14'000;
    RedisStore store = open(redis, limits);
    const std::string a = store.put(bundleOf("a", 3000), true).entry.id;
    const std::string b = store.put(bundleOf("b", 3000), true).entry.id;
    const std::string c = store.put(bundleOf("c", 3000), true).entry.id;
    const std::string d = store.put(bundleOf("d", 3000), true).entry.id;
    CHECK(store.get(a));
    const std::string e = store.put(bundleOf("e", 3000), true).entry.id;
    CHECK_FALSE(store.get(b));
    for (const std::string& id : {a, c, d, e}) CHECK(store.get(id));
    CHECK(store.bytes() <= limits.bytes);
    CHECK(codeOf([&] { store.put(bundleOf("f", 20'000), false); }) == "limit.store");
    for (const std::string& id : {a, c, d, e}) CHECK(store.get(id));

    limits.scenes = 2;
    RedisStore few = open(redis, limits);
    const std::string f = few.put(bundleOf("f"), false).entry.id;
    CHECK(few.get(f));
    CHECK(few.get(e));
    for (const std::string& id : {a, c, d}) CHECK_FALSE(few.get(id));
}

TEST_CASE("scenes in Redis expire, and leave nothing behind") {
    const RedisServer redis;
    StoreLimits limits;
    limits.expire = std::chrono::seconds(1);
    RedisStore store = open(redis, limits);
    const std::string id = store.put(bundleOf("short-lived"), true).entry.id;
    limits.expire = std::chrono::seconds(0);
    RedisStore lasting = open(redis, limits);
    const auto kept = lasting.put(bundleOf("lasting"), true).entry;
    CHECK(kept.expires == Time::max());
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (store.get(id) && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    CHECK_FALSE(store.get(id));
    CHECK(store.list().size() == 1);
    CHECK(store.expire() == 1);
    CHECK(store.expire() == 0);
    CHECK(store.bytes() == kept.bytes);
    CHECK(lasting.get(kept.id));
}

TEST_CASE("an unreachable Redis is a 503, and scenes in memory are still served") {
    RedisServer redis;
    RedisStore store = open(redis);
    const std::string warm = store.put(bundleOf("warm", 100), true).entry.id;
    const std::string cold = store.put(bundleOf("cold", 100), true).entry.id;
    CHECK(store.get(warm));
    CHECK(store.isReachable());
    redis.stop();
    for (int i = 0; i < 3; ++i) {
        CHECK(codeOf([&] { store.put(bundleOf("new"), false); }) == "store.unreachable");
        CHECK(codeOf([&] { store.get(cold); }) == "store.unreachable");
        CHECK(codeOf([&] { store.remove(cold); }) == "store.unreachable");
        CHECK(codeOf([&] { store.list(); }) == "store.unreachable");
        CHECK(store.get(warm));
        CHECK(store.expire() == 0);
    }
    CHECK_FALSE(store.isReachable());

    redis.start();
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (codeOf([&] { store.get(cold); }) != "none" && std::chrono::steady_clock::now() < end)
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    REQUIRE(store.get(cold));  // it was acknowledged, and Redis was killed
    CHECK(store.get(cold)->bundle->files.at("scene.xml") == "cold");
    CHECK(store.isReachable());
    CHECK(store.list().size() == 2);
}

TEST_CASE("a Redis without room, and one that wants a password, are distinguished") {
    RedisServer redis;
    RedisStore store = open(redis);
    const std::string before = store.put(bundleOf("before", 100), false).entry.id;
    RedisLink admin(redis.address(), [](const std::string&) {});
    admin.ask({"CONFIG", "SET", "maxmemory", "1"});
    CHECK(codeOf([&] { store.put(bundleOf("after", 100), false); }) == "store.full");
    CHECK(store.get(before));
    admin.ask({"CONFIG", "SET", "maxmemory", "0"});
    CHECK(store.put(bundleOf("after", 100), false).created);

    admin.ask({"CONFIG", "SET", "requirepass", "s3cret"});
    RedisStore stranger = open(redis);
    CHECK(codeOf([&] { stranger.put(bundleOf("x"), false); }) == "store.failed");
    RedisAddress address = redis.address();
    address.password = "s3cret";
    const auto quiet = [](const std::string&) {};
    CHECK(RedisStore(address, {}, quiet).get(before));
    address.password = "wrong";
    CHECK(codeOf([&] { RedisStore(address, {}, quiet).list(); }) == "store.unreachable");
}

TEST_CASE("data that were changed inside Redis are not served") {
    const RedisServer redis;
    RedisStore store = open(redis);
    const std::string id = store.put(bundleOf("fine", 300), true).entry.id;
    RedisLink admin(redis.address(), [](const std::string&) {});
    admin.ask({"SETRANGE", "{farol}:scene:" + id, "200", "bent"});
    CHECK_FALSE(store.get(id));
    CHECK(store.list().empty());
    CHECK(store.bytes() == 0);
    CHECK(store.put(bundleOf("fine", 300), true).created);
    CHECK(store.get(id));
}

TEST_CASE("a scene whose digest differs is set aside, and replaced when it is sent again") {
    const RedisServer redis;
    RedisStore store = open(redis);
    const std::string id = store.put(bundleOf("fine", 300), true).entry.id;
    RedisLink admin(redis.address(), [](const std::string&) {});
    admin.ask({"SETRANGE", "{farol}:scene:" + id, "200", "bent"});
    // It was not read yet, so the damage is not known: put() finds it there.
    CHECK_FALSE(store.put(bundleOf("fine", 300), false).created);
    const auto kept = store.get(id);
    REQUIRE(kept);
    CHECK(kept->entry.listed);
    RedisStore other = open(redis);
    admin.ask({"SETRANGE", "{farol}:scene:" + id, "200", "bent"});
    CHECK_FALSE(other.get(id));
    CHECK(admin.ask({"EXISTS", "{farol}:aside:" + id}).number == 1);
    CHECK(admin.ask({"TTL", "{farol}:aside:" + id}).number > 0);
    CHECK(other.bytes() == 0);
}

TEST_CASE("many threads of two services share a Redis") {
    const RedisServer redis;
    StoreLimits limits;
    limits.bytes = 20'000;
    RedisStore one = open(redis, limits), other = open(redis, limits);
    std::atomic<int> wrong{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            RedisStore& store = t % 2 == 0 ? one : other;
            for (int i = 0; i < 30; ++i) {
                const std::string text = std::to_string((t + i) % 12);
                const std::string id = store.put(bundleOf(text, 2000), i % 2 == 0).entry.id;
                const auto found = store.get(id);
                if (found && found->bundle->files.at("scene.xml") != text) ++wrong;
                if (i % 7 == 0) store.remove(id);
                store.list();
            }
        });
    for (std::thread& thread : threads) thread.join();
    CHECK(wrong == 0);
    CHECK(one.bytes() <= limits.bytes);
    std::uint64_t sum = 0;
    RedisLink admin(redis.address(), [](const std::string&) {});
    const auto sizes = admin.ask({"HGETALL", "{farol}:sizes"}).parts;
    for (std::size_t i = 1; i < sizes.size(); i += 2) sum += std::stoull(sizes[i].text);
    CHECK(one.bytes() == sum);
}
