// Requests that begin badly, and clients that hold connections: bounded, and nobody else's trouble.
#include <catch2/catch.hpp>
#include <thread>

#include "fixture.h"

using namespace farol;
using namespace farol::test;
using namespace std::chrono_literals;

namespace {

constexpr const char* kLivez = "GET /livez HTTP/1.1\r\nHost: x\r\n\r\n";

std::string repeat(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
}

/// Nothing ends by a time limit: what is closed is displaced.
void patient(server::http::ListenOptions& listen) {
    listen.keepAlive = 1h;
    listen.timeouts = {1h, 1h, 1h, 1h, 30s};
}

double metric(int port, const std::string& name) {
    const std::string text = get(port, "/metrics").body;
    const std::size_t at = text.find("\n" + name + " ");
    REQUIRE(at != std::string::npos);
    return std::stod(text.substr(at + name.size() + 2));
}

double closed(int port, const std::string& reason) {
    return metric(port, "farol_http_connections_closed_total{reason=\"" + reason + "\"}");
}

using Clients = std::vector<std::unique_ptr<RawClient>>;

Clients connected(int port, int count, const std::string& from, const std::string& bytes) {
    Clients clients;
    for (int i = 0; i < count; ++i) {
        clients.push_back(std::make_unique<RawClient>(port, from));
        clients.back()->send(bytes);
    }
    return clients;
}

}  // namespace

TEST_CASE("a few blank lines before a request are skipped, many end the connection") {
    FakeServer server;
    RawClient client(server.port());
    for (int i = 0; i < 3; ++i) {
        client.send(repeat("\r\n", 8) + kLivez);
        CHECK(client.read().status == 200);
    }
    for (const char c : "\r\n\r\n" + std::string(kLivez)) client.send(std::string(1, c));
    CHECK(client.read().status == 200);
    for (const int lines : {9, 500'000}) {
        RawClient flood(server.port());
        flood.send(repeat("\r\n", lines));
        const Answer answer = flood.read();
        CHECK(answer.status == 400);
        CHECK(answer.code() == "http.syntax");
        CHECK(flood.closedByServer());
    }
    RawClient slow(server.port());
    for (int i = 0; i < 9; ++i) slow.send("\r\n");
    CHECK(slow.read().status == 400);
}

TEST_CASE("blank lines do not prolong the time of an idle connection") {
    FakeServer server({}, [](server::http::ListenOptions& listen) {
        patient(listen);
        listen.keepAlive = 300ms;
    });
    RawClient client(server.port());
    std::thread sender([&] {
        for (int i = 0; i < 8; ++i) {
            client.send("\r\n");
            std::this_thread::sleep_for(200ms);
        }
    });
    // It would take 1.7 s, and is closed without an answer; a slow machine only makes it earlier.
    CHECK(client.read().status == 0);
    CHECK(client.closedByServer());
    sender.join();
}

TEST_CASE("a head holds a bounded number of headers") {
    FakeServer server;
    const auto with = [&](int lines) {
        RawClient client(server.port());
        client.send("GET /livez HTTP/1.1\r\nHost: x\r\n" + repeat("a:b\r\n", lines) + "\r\n");
        return client.read();
    };
    CHECK(with(127).status == 200);
    CHECK(with(128).status == 431);
    CHECK(with(6000).code() == "http.head");
}

TEST_CASE("thousands of requests in one piece are all answered, in order") {
    FakeServer server;
    constexpr int kRequests = 3000;
    RawClient client(server.port());
    std::thread sender([&] {
        client.send(repeat(std::string(kLivez) + "GET /version HTTP/1.1\r\nHost: x\r\n\r\n",
                           kRequests / 2));
    });
    int right = 0;
    for (int i = 0; i < kRequests; ++i) {
        const auto answer = client.read().json();
        right += answer.contains(i % 2 == 0 ? "status" : "name") ? 1 : 0;
    }
    sender.join();
    CHECK(right == kRequests);
}

TEST_CASE("a table full of one client's idle connections has room for all others") {
    // Nothing sent, blank lines, in the middle of a head, answered.
    for (const char* const text : {"", "\r\n", "GET /", kLivez}) {
        const std::string bytes = text;
        INFO(bytes);
        FakeServer server({}, [](server::http::ListenOptions& listen) {
            patient(listen);
            listen.maxConnections = 20;
        });
        const int port = server.port();
        Clients hog = connected(port, 20, "", bytes);
        if (bytes == kLivez)
            for (auto& client : hog) REQUIRE(client->read().status == 200);
        Clients others = connected(port, 5, "127.0.0.2", kLivez);
        for (auto& other : others) CHECK(other->read().status == 200);
        if (bytes.empty()) {  // its oldest ones made room
            for (std::size_t i = 0; i < 5; ++i) CHECK(hog.at(i)->closedByServer());
            hog.back()->send(kLivez);
            CHECK(hog.back()->read().status == 200);
        }
        // A client of the same address has a place, too, and it is the hog that makes room.
        CHECK(closed(port, "displaced") >= 5);
        CHECK(closed(port, "connections_full") == 0);
        for (auto& other : others) {
            other->send(kLivez);
            CHECK(other->read().status == 200);
        }
    }
}

TEST_CASE("a connection that was of use is kept before those that never asked") {
    FakeServer server({}, [](server::http::ListenOptions& listen) {
        patient(listen);
        listen.maxConnections = 20;
    });
    RawClient useful(server.port());
    useful.send(kLivez);
    REQUIRE(useful.read().status == 200);
    const Clients silent = connected(server.port(), 100, "", "");
    CHECK(get(server.port(), "/livez").status == 200);
    useful.send(kLivez);
    CHECK(useful.read().status == 200);
}

TEST_CASE("a client has a bounded number of connections") {
    FakeServer server({}, [](server::http::ListenOptions& listen) {
        patient(listen);
        listen.threads = 4;
        listen.maxConnections = 100;
        listen.connectionsPerClient = 3;
    });
    const int port = server.port();
    std::atomic<bool> release{false};
    server.backend.onRender = [&](const render::Job&) {
        while (!release) std::this_thread::sleep_for(1ms);
        return render::Picture{};
    };
    Clients busy;
    for (int i = 0; i < 3; ++i) {
        busy.push_back(std::make_unique<RawClient>(port, "127.0.0.3"));
        busy.back()->send(
            "POST /v1/render HTTP/1.1\r\nHost: x\r\nContent-Type: text/xml\r\n"
            "Content-Length: 8\r\n\r\n<world/>");
    }
    while (server.backend.renders < 3) std::this_thread::sleep_for(1ms);
    RawClient extra(port, "127.0.0.3");
    const Answer refused = extra.read();
    CHECK(refused.status == 503);
    CHECK(refused.code() == "busy.connections");
    CHECK(refused.header("retry-after") == "1");
    CHECK(get(port, "/livez").status == 200);  // of another address
    CHECK(closed(port, "client_full") == 1);
    release = true;
    for (auto& client : busy) CHECK(client->read().status == 200);
    // When they are idle, the oldest gives its place to a new one.
    while (metric(port, "farol_http_connections{state=\"idle\"}") < 3)
        std::this_thread::sleep_for(1ms);
    RawClient later(port, "127.0.0.3");
    later.send(kLivez);
    CHECK(later.read().status == 200);
    CHECK(closed(port, "displaced") == 1);
}

TEST_CASE("a service that drains goes on serving, unready, and keeps no connection") {
    FakeServer server;
    RawClient client(server.port());
    client.send(kLivez);
    CHECK_FALSE(client.read().closed);
    server.drain();
    const Answer unready = get(server.port(), "/readyz");
    CHECK(unready.status == 503);
    CHECK(unready.code() == "busy.draining");
    client.send(kLivez);
    const Answer last = client.read();
    CHECK(last.status == 200);
    CHECK(last.closed);
    CHECK(post(server.port(), "/v1/render", "<world/>").status == 200);
}
