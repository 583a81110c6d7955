// Errors of the HTTP library of Debian 12 (cpp-httplib 0.11.4), and how connections behave.
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "fixture.h"
#include "tests/support/skip.h"

using namespace farol;
using namespace farol::test;

namespace {

struct Raw {
    const char* name;
    std::string bytes;
    int status;
    const char* code;
};

std::string requestWith(const std::string& headers, const std::string& body = "") {
    return "POST /v1/render HTTP/1.1\r\nHost: x\r\nContent-Type: application/xml\r\n" + headers +
           "\r\n" + body;
}

std::string chunk(const std::string& bytes) {
    char size[32];
    std::snprintf(size, sizeof size, "%zx\r\n", bytes.size());
    return size + bytes + "\r\n";
}

}  // namespace

TEST_CASE("requests that must not be understood are refused and end the connection") {
    FakeServer server;
    const std::string big(9000, 'a');
    const std::vector<Raw> table = {
        {"no HTTP", "hello\r\n\r\n", 400, "http.syntax"},
        {"no version", "GET /\r\n\r\n", 400, "http.syntax"},
        {"other version", "GET / HTTP/2.0\r\n\r\n", 505, "http.version"},
        {"blank in target", "GET /a b HTTP/1.1\r\n\r\n", 400, "http.syntax"},
        {"unknown method", "BREW /livez HTTP/1.1\r\n\r\n", 501, "http.method-unknown"},
        {"bad escape", "GET /%zz HTTP/1.1\r\n\r\n", 400, "http.target"},
        {"NUL in path", "GET /v1/scenes/a%00b HTTP/1.1\r\n\r\n", 400, "http.target"},
        {"newline in path", "GET /v1/scenes/a%0d%0aX:y HTTP/1.1\r\n\r\n", 400, "http.target"},
        {"long address", "GET /?a=" + big + " HTTP/1.1\r\n\r\n", 414, "http.uri-too-long"},
        {"long path", "GET /" + big.substr(0, 2000) + " HTTP/1.1\r\n\r\n", 414,
         "http.uri-too-long"},
        {"address without end", "GET /" + std::string(40'000, 'a'), 414, "http.uri-too-long"},
        {"headers without end", "GET / HTTP/1.1\r\nA: " + std::string(40'000, 'a') + "\r\n\r\n",
         431, "http.head"},
        {"header without colon", "GET / HTTP/1.1\r\nnonsense\r\n\r\n", 400, "http.syntax"},
        {"blank before colon", "GET / HTTP/1.1\r\nHost : x\r\n\r\n", 400, "http.syntax"},
        {"folded header", "GET / HTTP/1.1\r\nA: b\r\n c\r\n\r\n", 400, "http.syntax"},
        {"bare line feed in a header", "GET / HTTP/1.1\r\nA: b\nX: c\r\n\r\n", 400, "http.syntax"},
        {"no length", requestWith(""), 411, "http.length-required"},
        {"length is no number", requestWith("Content-Length: ten\r\n"), 400, "http.length"},
        {"negative length", requestWith("Content-Length: -1\r\n"), 400, "http.length"},
        {"huge length", requestWith("Content-Length: 99999999999999999999\r\n"), 400,
         "http.length"},
        {"two lengths", requestWith("Content-Length: 1\r\nContent-Length: 2\r\n", "ab"), 400,
         "http.length"},
        {"length and chunks",
         requestWith("Content-Length: 3\r\nTransfer-Encoding: chunked\r\n", "0\r\n\r\n"), 400,
         "http.length"},
        {"other transfer encoding", requestWith("Transfer-Encoding: gzip, chunked\r\n"), 501,
         "http.transfer-encoding"},
        {"compressed body", requestWith("Content-Encoding: gzip\r\nContent-Length: 3\r\n", "abc"),
         415, "http.content-encoding"},
        {"brotli body", requestWith("Content-Encoding: br\r\nContent-Length: 3\r\n", "abc"), 415,
         "http.content-encoding"},
    };
    for (const Raw& row : table) {
        INFO(row.name);
        RawClient client(server.port());
        client.send(row.bytes);
        const Answer answer = client.read();
        CHECK(answer.status == row.status);
        CHECK(answer.code() == row.code);
        CHECK(answer.header("content-type") == "application/problem+json");
        CHECK(answer.header("connection") == "close");
        CHECK(client.closedByServer());
    }
    CHECK(server.backend.renders == 0);
    CHECK(get(server.port(), "/livez").status == 200);
}

TEST_CASE("bodies are bounded however they arrive") {
    server::ServiceOptions options;
    options.maxBodyBytes = 100'000;
    FakeServer server(options);

    SECTION("announced too long: refused before it is sent") {
        RawClient client(server.port());
        client.send(requestWith("Content-Length: 100001\r\n"));
        const Answer answer = client.read();
        CHECK(answer.status == 413);
        CHECK(answer.code() == "limit.body");
    }
    SECTION("in chunks without an announcement") {
        RawClient client(server.port());
        client.send(requestWith("Transfer-Encoding: chunked\r\n"));
        for (int i = 0; i < 40; ++i) client.send(chunk(std::string(10'000, ' ')));
        const Answer answer = client.read();
        CHECK(answer.status == 413);
        CHECK(answer.code() == "limit.body");
    }
    SECTION("in one chunk that claims to be endless") {
        RawClient client(server.port());
        client.send(requestWith("Transfer-Encoding: chunked\r\n", "7fffffffffffffff\r\n"));
        for (int i = 0; i < 40; ++i) client.send(std::string(10'000, ' '));
        CHECK(client.read().code() == "limit.body");
    }
    SECTION("chunks within the bound are joined") {
        std::string seen;
        server.backend.onRender = [&](const render::Job& job) {
            seen = job.xml;
            return render::Picture{};
        };
        RawClient client(server.port());
        client.send(requestWith("Transfer-Encoding: chunked\r\n",
                                chunk("<wor") + chunk("ld/>") + "0\r\n\r\n"));
        CHECK(client.read().status == 200);
        CHECK(seen == "<world/>");
    }
    SECTION("at the bound exactly") {
        CHECK(post(server.port(), "/v1/render", std::string(100'000, ' ')).status == 200);
        CHECK(post(server.port(), "/v1/render", std::string(100'001, ' ')).status == 413);
    }
    SECTION("cut off") {
        server::ServiceOptions plain;
        FakeServer impatient(plain, [](server::http::ListenOptions& listen) {
            listen.timeouts.body = std::chrono::milliseconds(200);
        });
        RawClient client(impatient.port());
        client.send(requestWith("Content-Length: 10\r\n", "<wo"));
        const Answer answer = client.read();
        CHECK(answer.status == 400);
        CHECK(answer.code() == "http.body");
    }
    SECTION("Expect: 100-continue is answered only for a body that is wanted") {
        RawClient wanted(server.port());
        wanted.send(requestWith("Expect: 100-continue\r\nContent-Length: 8\r\n"));
        CHECK(wanted.read().status == 100);
        wanted.send("<world/>");
        CHECK(wanted.read().status == 200);
        RawClient unwanted(server.port());
        unwanted.send(requestWith("Expect: 100-continue\r\nContent-Length: 900000\r\n"));
        CHECK(unwanted.read().status == 413);
    }
}

TEST_CASE("a body on a GET is never taken for the next request") {
    FakeServer server;
    RawClient client(server.port());
    const std::string smuggled = "GET /version HTTP/1.1\r\nHost: x\r\n\r\n";
    client.send("GET /livez HTTP/1.1\r\nHost: x\r\nContent-Length: " +
                std::to_string(smuggled.size()) + "\r\n\r\n" + smuggled);
    CHECK(client.read().status == 200);
    CHECK(client.read().status == 0);
    CHECK(client.closedByServer());
}

TEST_CASE("an unread body is never taken for the next request") {
    FakeServer server;
    RawClient client(server.port());
    const std::string smuggled = "GET /version HTTP/1.1\r\nHost: x\r\n\r\n";
    client.send("POST /nowhere HTTP/1.1\r\nHost: x\r\nContent-Length: " +
                std::to_string(smuggled.size()) + "\r\n\r\n" + smuggled);
    CHECK(client.read().status == 404);
    CHECK(client.read().status == 0);
}

TEST_CASE("exception text and client-made addresses stay inside") {
    FakeServer server;
    server.backend.onRender = [](const render::Job&) -> render::Picture {
        throw std::runtime_error("secret of the house");
    };
    const Answer answer =
        ask(server.port(), {"POST",
                            "/v1/render",
                            {{"REMOTE_ADDR", "6.6.6.6"}, {"Content-Type", "text/xml"}},
                            "<world/>"});
    CHECK(answer.status == 500);
    CHECK(answer.code() == "internal");
    CHECK(answer.body.find("secret") == std::string::npos);
    for (const auto& [name, value] : answer.headers) {
        CHECK(name != "exception_what");
        CHECK(value.find("secret") == std::string::npos);
    }
    bool told = false;
    for (const std::string& line : server.log()) {
        told = told || line.find("secret of the house") != std::string::npos;
        CHECK(line.find("6.6.6.6") == std::string::npos);
    }
    CHECK(told);  // the operator learns what the client does not
}

TEST_CASE("connections are kept, pipelined and closed as asked") {
    FakeServer server;
    RawClient client(server.port());
    for (int i = 0; i < 50; ++i) {
        client.send("GET /livez HTTP/1.1\r\nHost: x\r\n\r\n");
        REQUIRE(client.read().status == 200);
    }
    client.send(
        "GET /livez HTTP/1.1\r\n\r\nGET /version HTTP/1.1\r\nHost: x\r\n\r\n"
        "HEAD / HTTP/1.1\r\nHost: x\r\n\r\n");
    CHECK(client.read().status == 200);
    CHECK(client.read().json().value("name", "") == "farol");
    const Answer head = client.read(false);
    CHECK(head.status == 200);
    CHECK(head.header("content-length") != "0");
    client.send("GET /livez HTTP/1.1\r\nConnection: close\r\n\r\n");
    CHECK(client.read().closed);
    CHECK(client.closedByServer());

    RawClient old(server.port());
    old.send("GET /livez HTTP/1.0\r\n\r\n");
    CHECK(old.read().status == 200);
    CHECK(old.closedByServer());
}

TEST_CASE("idle and slow connections starve nobody") {
    FakeServer server({}, [](server::http::ListenOptions& listen) {
        listen.threads = 2;
        listen.timeouts.head = std::chrono::milliseconds(300);
    });
    std::vector<std::unique_ptr<RawClient>> idle;
    for (int i = 0; i < 100; ++i) {
        idle.push_back(std::make_unique<RawClient>(server.port()));
        if (i % 2 == 0) {
            idle.back()->send("GET /livez HTTP/1.1\r\n\r\n");
            REQUIRE(idle.back()->read().status == 200);
        }
    }
    CHECK(get(server.port(), "/livez").status == 200);
    // Heads that never end, more of them than there are threads, hold no thread either.
    std::vector<std::unique_ptr<RawClient>> trickling;
    for (int i = 0; i < 20; ++i) {
        trickling.push_back(std::make_unique<RawClient>(server.port()));
        trickling.back()->send("GET /livez HTTP/1.1\r\nX: ");
    }
    CHECK(get(server.port(), "/livez").status == 200);
    trickling.front()->send("y\r\n\r\n");
    const Answer patient = trickling.front()->read();
    CHECK((patient.status == 200 || patient.status == 408));  // by when its bytes arrived
    for (std::size_t i = 1; i < trickling.size(); ++i) CHECK(trickling[i]->read().status == 408);
    RawClient slow(server.port());
    slow.send("GET /livez HTT");
    CHECK(slow.read().status == 408);
    CHECK(slow.closedByServer());
    CHECK(get(server.port(), "/livez").status == 200);
}

TEST_CASE("a head may come byte by byte, and its end before the answer") {
    FakeServer server;
    RawClient slow(server.port());
    for (const char c : std::string("GET /livez HTTP/1.1\r\nHost: x\r\n\r\n"))
        slow.send(std::string(1, c));
    CHECK(slow.read().status == 200);
    slow.send("GET /livez HTTP/1.1\r\n\r\nGET /vers");
    CHECK(slow.read().status == 200);
    slow.send("ion HTTP/1.1\r\nHost: x\r\n\r\n");
    CHECK(slow.read().status == 200);
    slow.send("GET /livez HTTP/1.1\r\n\r\n");
    CHECK(slow.read().status == 200);
    {
        RawClient gone(server.port());
        gone.send("GET /livez HTTP/1.1\r\nHo");
    }
    RawClient half(server.port());
    half.send("GET /livez HTTP/1.1\r\n\r\n");
    half.endSending();
    CHECK(half.read().status == 200);
    CHECK(half.closedByServer());
}

TEST_CASE("connections over the limit get a response that says so") {
    FakeServer server({}, [](server::http::ListenOptions& listen) { listen.maxConnections = 3; });
    std::atomic<bool> release{false};
    server.backend.onRender = [&](const render::Job&) {
        while (!release) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return render::Picture{};
    };
    std::vector<std::unique_ptr<RawClient>> held;
    for (int i = 0; i < 3; ++i) {
        held.push_back(std::make_unique<RawClient>(server.port()));
        held.back()->send(requestWith("Content-Length: 8\r\n", "<world/>"));
    }
    while (server.backend.renders < 3) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    RawClient extra(server.port());
    const Answer answer = extra.read();
    CHECK(answer.status == 503);
    CHECK(answer.header("retry-after") == "1");
    CHECK(answer.header("content-type") == "application/problem+json");
    CHECK(answer.code() == "busy.connections");
    CHECK_FALSE(answer.header("x-request-id").empty());
    CHECK(answer.json().value("requestId", "") == answer.header("x-request-id"));
    release = true;
    for (const auto& client : held) CHECK(client->read().status == 200);
    Answer later;  // in the place of an idle one, as soon as there is one
    for (int i = 0; i < 1000 && later.status != 200; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        later = get(server.port(), "/livez");
    }
    CHECK(later.status == 200);
}

TEST_CASE("a recursive match on a long Range header cannot happen") {
    FakeServer server;
    std::string ranges = "bytes=0-";
    while (ranges.size() < 7900) ranges += ",0-";
    const Answer answer = get(server.port(), "/livez", {{"Range", ranges}});
    CHECK(answer.status == 200);
    CHECK(answer.header("content-range").empty());
}

TEST_CASE("descriptors beyond 1024 are served") {
    FakeServer server({},
                      [](server::http::ListenOptions& listen) { listen.maxConnections = 3000; });
    std::vector<std::unique_ptr<RawClient>> held;
    try {
        for (int i = 0; i < 600; ++i) held.push_back(std::make_unique<RawClient>(server.port()));
    } catch (const std::exception& fault) {
        skip(std::string("too few descriptors: ") + fault.what());
    }
    // Each connection is two descriptors of this process: the last ones are beyond 1024.
    held.back()->send("GET /livez HTTP/1.1\r\n\r\n");
    CHECK(held.back()->read().status == 200);
}

TEST_CASE("stopping ends what is being served and takes nothing new") {
    auto server = std::make_unique<FakeServer>();
    std::atomic<bool> started{false}, release{false};
    server->backend.onRender = [&](const render::Job&) {
        started = true;
        while (!release) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        render::Picture picture;
        picture.bytes = "done";
        return picture;
    };
    const int port = server->port();
    Answer answer;
    std::thread client([&] { answer = post(port, "/v1/render", "<world/>"); });
    while (!started) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    std::thread stopper([&] { server->stop(); });
    bool refused = false;
    for (int i = 0; i < 500 && !refused; ++i) {
        try {
            RawClient probe(port);
        } catch (const std::exception&) {
            refused = true;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    CHECK(refused);
    release = true;
    client.join();
    stopper.join();
    CHECK(answer.status == 200);
    CHECK(answer.body == "done");
    CHECK(answer.closed);
}

TEST_CASE("a port in use is an error, not a silent share") {
    FakeServer server;
    server::http::ListenOptions listen;
    listen.port = server.port();
    FakeBackend backend;
    CHECK_THROWS_AS(TestServer(backend, {}, listen), std::runtime_error);
}
