// Clients that send slowly or read nothing: they hold memory that is bounded, and no thread.
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "fixture.h"
#include "worker/messages.h"

using namespace farol;
using namespace farol::test;
using namespace std::chrono_literals;

namespace {

constexpr int kThreads = 4;
constexpr int kSlow = 3 * kThreads;
constexpr std::size_t kPicture = std::size_t{8} << 20U;  // more than the kernel takes for anyone

/// Nothing that a client does ends by a time limit here: what a test waits for must come by itself.
FakeServer& patient(std::unique_ptr<FakeServer>& server, std::size_t bufferBytes = 1U << 30U) {
    server = std::make_unique<FakeServer>(server::ServiceOptions{},
                                          [&](server::http::ListenOptions& listen) {
                                              listen.threads = kThreads;
                                              listen.bufferBytes = bufferBytes;
                                              listen.keepAlive = 1h;
                                              listen.timeouts = {1h, 1h, 1h, 1h, 30s};
                                          });
    server->backend.onRender = [](const render::Job& job) {
        render::Picture picture;
        picture.bytes = std::string(kPicture - 1, 'p') + job.xml.back();
        return picture;
    };
    return *server;
}

std::string asking(const std::string& xml = "<world/>") {
    return "POST /v1/render HTTP/1.1\r\nHost: x\r\nContent-Type: text/xml\r\nContent-Length: " +
           std::to_string(xml.size()) + "\r\n\r\n" + xml;
}

double in(const std::string& text, const std::string& name) {
    const std::size_t at = text.find("\n" + name + " ");
    return at == std::string::npos ? -1.0 : std::stod(text.substr(at + name.size() + 2));
}

double metric(int port, const std::string& name) { return in(get(port, "/metrics").body, name); }

/// Waits until the metric has the value; false if it never does.
bool becomes(int port, const std::string& name, double value) {
    for (int i = 0; i < 3000; ++i) {
        if (metric(port, name) == value) return true;
        std::this_thread::sleep_for(10ms);
    }
    return false;
}

using Clients = std::vector<std::unique_ptr<RawClient>>;

Clients connected(int port, int count, const std::string& each) {
    Clients clients;
    for (int i = 0; i < count; ++i) {
        clients.push_back(std::make_unique<RawClient>(port));
        clients.back()->send(each);
    }
    return clients;
}

}  // namespace

TEST_CASE("clients that ask and read nothing hold no thread, and read their answers later") {
    std::unique_ptr<FakeServer> owner;
    const int port = patient(owner).port();
    std::string wanted;
    for (char name = 'a'; name < 'e'; ++name) wanted += asking(std::string("<w/>") + name);
    Clients clients = connected(port, kSlow, wanted);
    CHECK(becomes(port, "farol_http_connections{state=\"sending\"}", kSlow));
    // More of them than threads: this one is answered because nobody waits for them.
    CHECK(get(port, "/livez").status == 200);
    // The second request of none was begun while the answer to its first is under way.
    CHECK(owner->backend.renders == kSlow);
    CHECK(metric(port, "farol_http_buffered_bytes") > 0);
    CHECK(metric(port, "farol_http_buffered_bytes") <= 1.1 * kSlow * kPicture);
    for (auto& client : clients)
        for (char name = 'a'; name < 'e'; ++name) {
            const Answer answer = client->read();
            REQUIRE(answer.status == 200);
            REQUIRE(answer.body.size() == kPicture);
            CHECK(answer.body.back() == name);
        }
    CHECK(owner->backend.renders == 4 * kSlow);
    CHECK(becomes(port, "farol_http_buffered_bytes", 0));
}

TEST_CASE("clients that stall in the middle of a request hold no thread") {
    std::unique_ptr<FakeServer> owner;
    const int port = patient(owner).port();
    const std::string whole = asking("<world><!-- slow --></world>");
    const std::vector<std::string> beginnings = {
        whole.substr(0, 20),
        whole.substr(0, whole.size() - 5),
        "POST /v1/render HTTP/1.1\r\nHost: x\r\nContent-Type: text/xml\r\n"
        "Transfer-Encoding: chunked\r\n\r\n5\r\n<wor",
    };
    for (const std::string& beginning : beginnings) {
        INFO(beginning);
        Clients clients = connected(port, kSlow, beginning);
        CHECK(becomes(port, "farol_http_connections{state=\"receiving\"}", kSlow));
        CHECK(get(port, "/livez").status == 200);
        const bool isChunked = beginning.ends_with("<wor");
        for (auto& client : clients) {
            client->send(isChunked ? "l\r\n3\r\nd/>\r\n0\r\n\r\n" : whole.substr(beginning.size()));
            CHECK(client->read().status == 200);
        }
    }
    // A client that gets "100 Continue" and does not send its body.
    Clients clients = connected(port, kSlow,
                                "POST /v1/render HTTP/1.1\r\nHost: x\r\nContent-Type: text/xml\r\n"
                                "Expect: 100-continue\r\nContent-Length: 8\r\n\r\n");
    for (auto& client : clients) CHECK(client->read().status == 100);
    CHECK(get(port, "/livez").status == 200);
    for (auto& client : clients) {
        client->send("<world/>");
        CHECK(client->read().status == 200);
    }
}

TEST_CASE("refused clients that go on sending hold no thread") {
    std::unique_ptr<FakeServer> owner;
    const int port = patient(owner).port();
    Clients clients =
        connected(port, kSlow, "POST /nowhere HTTP/1.1\r\nHost: x\r\nContent-Length: 1000\r\n\r\n");
    for (auto& client : clients) CHECK(client->read().status == 404);
    CHECK(get(port, "/livez").status == 200);  // the others linger: their bodies may still come
    for (auto& client : clients) {
        client->send(std::string(1000, 'x'));
        CHECK(client->closedByServer());
    }
}

TEST_CASE("beyond the bound on memory the slowest clients are dropped, and no others") {
    std::unique_ptr<FakeServer> owner;
    const int port = patient(owner, 5 * kPicture).port();
    Clients slow;
    for (int i = 0; i < 3; ++i) {
        slow.push_back(std::make_unique<RawClient>(port));
        slow.back()->send(asking());
        REQUIRE(becomes(port, "farol_http_connections{state=\"sending\"}", i + 1));
    }
    Clients later = connected(port, kSlow, asking());
    const std::string closed = "farol_http_connections_closed_total{reason=\"buffers_full\"}";
    double dropped = 0, held = 0;
    for (int i = 0; i < 3000 && dropped + held < kSlow + 3; ++i) {
        std::this_thread::sleep_for(10ms);
        const std::string text = get(port, "/metrics").body;
        dropped = in(text, closed);
        held = in(text, "farol_http_connections{state=\"sending\"}");
    }
    CHECK(held >= 5);  // the kernel holds a part of each
    CHECK(held + dropped == kSlow + 3);
    CHECK(metric(port, "farol_http_buffered_bytes") <= 5.0 * kPicture);
    for (auto& client : slow) CHECK(client->read().body.size() < kPicture);
    int whole = 0;
    for (auto& client : later) whole += client->read().body.size() == kPicture ? 1 : 0;
    CHECK(whole == held);
    CHECK(get(port, "/livez").status == 200);
    bool told = false;
    for (const std::string& line : owner->log())
        told = told || line.find("\"sent\":false") != std::string::npos;
    CHECK(told);
}

TEST_CASE("a client that never reads its answer is given up, and so is one that never ends") {
    FakeServer server({}, [](server::http::ListenOptions& listen) {
        listen.timeouts.write = 200ms;
        listen.timeouts.body = 200ms;
    });
    server.backend.onRender = [](const render::Job&) {
        render::Picture picture;
        picture.bytes = std::string(kPicture, 'p');
        return picture;
    };
    const int port = server.port();
    RawClient reader(port);
    reader.send(asking());
    CHECK(becomes(port, "farol_http_connections_closed_total{reason=\"slow_reader\"}", 1));
    CHECK(reader.read().body.size() < kPicture);
    RawClient sender(port);
    sender.send(asking().substr(0, asking().size() - 1));
    CHECK(sender.read().code() == "http.body");
    CHECK(becomes(port, "farol_http_connections_closed_total{reason=\"slow_body\"}", 1));
}

TEST_CASE("a service that is asked to end delivers answers and bodies that are under way") {
    std::unique_ptr<FakeServer> owner;
    const int port = patient(owner).port();
    RawClient reader(port), sender(port), late(port), idle(port);
    reader.send(asking());
    CHECK(becomes(port, "farol_http_connections{state=\"sending\"}", 1));
    sender.send(asking().substr(0, asking().size() - 3));
    late.send("GET /livez HT");
    CHECK(becomes(port, "farol_http_connections{state=\"receiving\"}", 2));
    std::thread stopper([&] { owner->stop(); });
    CHECK(late.closedByServer());
    CHECK(idle.closedByServer());
    CHECK(reader.read().body.size() == kPicture);
    sender.send("d/>");
    const Answer answer = sender.read();
    CHECK(answer.body.size() == kPicture);
    CHECK(answer.closed);
    stopper.join();
}

TEST_CASE("who is refused for want of room is answered a little later, and holds no thread") {
    constexpr int kThreads = 2, kClients = 12;
    FakeServer server({}, [](server::http::ListenOptions& listen) { listen.threads = kThreads; });
    server.backend.onRender = [](const render::Job&) -> render::Picture {
        throw worker::Busy(worker::message<"busy.queue">(), 3);
    };
    std::vector<std::unique_ptr<RawClient>> clients;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < kClients; ++i) {
        clients.push_back(std::make_unique<RawClient>(server.port()));
        REQUIRE(
            clients.back()->send("POST /v1/render HTTP/1.1\r\nHost: a\r\nContent-Type: "
                                 "application/xml\r\nContent-Length: 8\r\n\r\n<world/>"));
    }
    CHECK(get(server.port(), "/livez").status == 200);
    for (const auto& client : clients) {
        const Answer answer = client->read();
        CHECK(answer.status == 503);
        CHECK(answer.code() == "busy.queue");
        CHECK(answer.header("retry-after") == "3");
        CHECK(client->closedByServer());
    }
    // Each one alone is late by that much; one after the other they would be by kClients / kThreads
    // times it.
    CHECK(std::chrono::steady_clock::now() - start >= std::chrono::milliseconds(200));
    // One that goes away meanwhile, and a server that ends: both are over without them.
    RawClient(server.port())
        .send(
            "POST /v1/render HTTP/1.1\r\nHost: a\r\nContent-Type: application/xml\r\n"
            "Content-Length: 8\r\n\r\n<world/>");
    server.stop();
}
