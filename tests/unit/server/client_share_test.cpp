// The share of one client in the memory of all.
#include <catch2/catch.hpp>

#include "server/client_bytes.h"
#include "server/rate_limiter.h"
#include "server/request/multipart.h"
#include "server/store/memory_store.h"
#include "worker/backend.h"

using namespace farol;
using namespace farol::server;
using namespace farol::server::store;
using namespace std::chrono_literals;

namespace {

scene::Bundle bundleOf(const std::string& text, std::size_t bytes) {
    return {"scene.xml", {{"scene.xml", text}, {"t/a.png", std::string(bytes, 'x')}}};
}

/// "done", or the code of what was thrown.
template <typename Work>
std::string codeOf(const Work& work) {
    try {
        work();
        return "done";
    } catch (const worker::Busy& busy) {
        return busy.code();
    } catch (const Error& error) {
        return error.code();
    }
}

}  // namespace

TEST_CASE("one client's uploads in memory make room from his own, never from those of others") {
    MemoryStore store({400'000, 1'000, 3'600s});
    const auto put = [&](const std::string& client, const std::string& text, std::size_t bytes) {
        std::string id;
        const std::string code =
            codeOf([&] { id = store.putFor(client, bundleOf(text, bytes), false).entry.id; });
        return code == "done" ? id : code;
    };
    std::vector<std::string> others;
    for (const char* client : {"a", "b", "c"})
        others.push_back(put(client, std::string("<a>") + client, 90'000));
    std::string last;
    for (int i = 0; i < 20; ++i) last = put("greedy", std::to_string(i), 80'000);
    for (const std::string& id : others) CHECK(store.get(id));
    CHECK(store.get(last));
    CHECK(store.bytes() <= 400'000);
    CHECK(put("greedy", "too large for one", 100'001) == "limit.store");
    // The room is used by four: a fifth is refused, and nobody loses anything.
    CHECK(put("late", "<late/>", 90'000) == "store.full");
    CHECK(put("late", "<late/>", 10'000).front() == '~');
    for (const std::string& id : others) CHECK(store.get(id));
    // Entries that are there already keep their owner.
    const auto again = store.putFor("greedy", bundleOf("<a>a", 90'000), true);
    CHECK_FALSE(again.created);
    for (int i = 0; i < 20; ++i) put("greedy", "x" + std::to_string(i), 80'000);
    CHECK(store.get(others[0]));
}

TEST_CASE("room is made from a client's own beyond his share, then from what nobody uses") {
    const Time start{};
    Index index({400, 8, 0s});
    const auto entry = [](const std::string& id, std::uint64_t bytes) {
        return Entry{id, false, Time::max(), bytes};
    };
    index.put(entry("a1", 60), "a", start);
    index.put(entry("a2", 40), "a", start);
    index.put(entry("b1", 100), "b", start);
    using Ids = std::vector<std::string>;
    CHECK(index.share().bytes == 100);
    CHECK(index.share().scenes == 2);
    CHECK(index.roomFor(entry("a3", 30), "a", start) == Ids{"a1"});
    CHECK(index.roomFor(entry("a3", 90), "a", start) == Ids{"a1", "a2"});
    CHECK(index.roomFor(entry("c1", 100), "c", start) == Ids{});
    index.put(entry("c1", 100), "c", start);
    index.put(entry("d1", 90), "d", start + 2h);
    CHECK_FALSE(index.roomFor(entry("e1", 20), "e", start + 30min));
    // After an hour without use scenes make room, the longest unused first.
    CHECK(index.roomFor(entry("e1", 20), "e", start + 1h) == Ids{"a1"});
    index.touch("a1", start + 2h);
    CHECK(index.roomFor(entry("e1", 20), "e", start + 2h) == Ids{"a2"});
    // Scenes count as bytes do.
    CHECK(index.roomFor(entry("d2", 1), "d", start + 2h) == Ids{});
    index.put(entry("d2", 1), "d", start + 2h);
    CHECK(index.roomFor(entry("d3", 1), "d", start + 2h) == Ids{"d1"});
}

TEST_CASE("one client's bodies in work are bounded, those of others are not touched") {
    ClientBytes bytes(100);
    bytes.add("a", 60);
    bytes.add("a", 40);
    CHECK(codeOf([&] { bytes.add("a", 1); }) == "limit.client");
    bytes.add("b", 100);
    bytes.remove("a", 40);
    bytes.add("a", 40);
    bytes.remove("a", 100);
    bytes.add("a", 500);  // one body alone is bounded by its own limit
}

TEST_CASE("a client's name is short, whatever a proxy passes on") {
    http::Request request;
    request.remoteAddress = "10.0.0.1";
    request.headers.emplace_back("x-forwarded-for", std::string(30'000, 'x'));
    CHECK(clientOf(request, true).size() == 64);
    CHECK(clientOf(request, false) == "10.0.0.1");
}

TEST_CASE("the largest part of a multipart body takes over its memory") {
    const std::string large(1 << 20, 'x');
    for (const int place : {0, 1, 2}) {
        std::string body;
        for (int i = 0; i < 3; ++i)
            body += "--b\r\nContent-Disposition: form-data; name=\"p" + std::to_string(i) +
                    "\"\r\n\r\n" + (i == place ? large : "small " + std::to_string(i)) + "\r\n";
        body += "--b--\r\n";
        const char* const begin = body.data();
        const std::size_t size = body.size();
        const std::vector<Part> parts = parseMultipart(std::move(body), "b");
        REQUIRE(parts.size() == 3);
        for (int i = 0; i < 3; ++i)
            CHECK((parts[static_cast<std::size_t>(i)].content ==
                   (i == place ? large : "small " + std::to_string(i))));
        const char* const content = parts[static_cast<std::size_t>(place)].content.data();
        CHECK((content >= begin && content < begin + size));
    }
}
