#include "core/lru_cache.h"

#include <catch2/catch.hpp>
#include <memory>
#include <string>

using farol::LruCache;

TEST_CASE("what was used longest ago goes first, and the bound is kept") {
    LruCache<std::string, int> cache(10);
    cache.put("a", 1, 4);
    cache.put("b", 2, 4);
    REQUIRE(cache.find("a") != nullptr);  // b is the older now
    cache.put("c", 3, 4);
    CHECK(cache.find("b") == nullptr);
    REQUIRE(cache.find("a") != nullptr);
    CHECK(*cache.find("a") == 1);
    CHECK(*cache.find("c") == 3);
    CHECK(cache.size() == 2);
}

TEST_CASE("a value over the bound stays until the next comes") {
    LruCache<int, std::unique_ptr<int>> cache(10);
    CHECK(*cache.put(1, std::make_unique<int>(7), 100) == 7);
    REQUIRE(cache.find(1) != nullptr);
    cache.put(2, std::make_unique<int>(8), 1);
    CHECK(cache.find(1) == nullptr);
    CHECK(cache.size() == 1);
}

TEST_CASE("those used last stay where the caller holds them, whatever they cost") {
    LruCache<int, int> cache(10);
    for (int i = 0; i < 3; ++i) cache.put(i, i, 6);
    CHECK(cache.size() == 1);
    REQUIRE(cache.find(2) != nullptr);
    cache.put(3, 3, 6, 3);
    cache.put(4, 4, 6, 3);
    CHECK(cache.size() == 3);
    cache.put(5, 5, 6, 3);
    CHECK(cache.size() == 3);
    CHECK(cache.find(2) == nullptr);
}
