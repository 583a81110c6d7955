// Requests that pages of other sites make browsers send (DNS rebinding, across origins).
#include <catch2/catch.hpp>

#include "fixture.h"

using namespace farol;
using namespace farol::test;

namespace {

using Headers = std::vector<std::pair<std::string, std::string>>;

struct Asked {
    std::string method, target, version;
    Headers headers;  ///< all of them, Host too
};

Answer send(int port, const Asked& asked) {
    std::string text = asked.method + " " + asked.target + " HTTP/" + asked.version + "\r\n";
    for (const auto& [name, value] : asked.headers) text += name + ": " + value + "\r\n";
    text += "Content-Type: text/xml\r\n";
    if (asked.method == "POST") text += "Content-Length: 8\r\n";
    RawClient client(port);
    client.send(text + "\r\n" + (asked.method == "POST" ? "<world/>" : ""));
    return client.read(asked.method != "HEAD");
}

server::http::ListenOptions anyPort() {
    server::http::ListenOptions listen;
    listen.port = 0;
    return listen;
}

Answer post(int port, const Headers& headers) {
    return send(port, {"POST", "/v1/scenes", "1.1", headers});
}

}  // namespace

TEST_CASE("a changing request of another origin is refused") {
    FakeServer server;
    const auto pair = [](const char* name, const std::string& value) {
        return std::pair<std::string, std::string>(name, value);
    };
    const auto site = [&](const std::string& value) { return pair("Sec-Fetch-Site", value); };
    const auto origin = [&](const std::string& value) { return pair("Origin", value); };
    const auto host = [&](const std::string& value) { return pair("Host", value); };
    struct Row {
        Headers headers;
        bool passes;
    };
    const std::vector<Row> table = {
        {{host("farol:8080")}, true},  // a program
        {{host("farol:8080"), origin("http://farol:8080")}, true},
        {{host("farol:8080"), origin("http://farol:8080"), site("same-origin")}, true},
        {{host("farol:8080"), site("same-origin")}, true},
        {{host("farol:8080"), site("none")}, true},  // typed by its user
        {{host("FAROL.:8080"), origin("http://farol:8080")}, true},
        {{host("farol"), origin("http://farol")}, true},
        {{host("farol:80"), origin("http://farol")}, true},
        {{host("farol"), origin("https://farol")}, true},  // a proxy ends TLS
        {{host("farol:443"), origin("https://farol")}, true},
        {{host("[::1]:8080"), origin("http://[0:0::1]:8080")}, true},
        {{host("farol:8080"), origin("http://farol")}, false},
        {{host("farol"), origin("http://farol:8080")}, false},
        {{host("farol"), origin("http://farol:443")}, false},
        {{host("farol:8080"), origin("http://farol:8081")}, false},
        {{host("farol:8080"), origin("http://evil.example")}, false},
        {{host("farol:8080"), origin("http://farol.evil.example:8080")}, false},
        {{host("farol:8080"), origin("null")}, false},
        {{host("farol:8080"), origin("")}, false},
        {{host("farol:8080"), origin("farol:8080")}, false},
        {{host("farol:8080"), origin("http://farol:8080/")}, false},
        {{host("farol:8080"), origin("http://farol:8080 http://farol:8080")}, false},
        {{host("farol:8080"), origin("http://farol:8080"), origin("http://evil.example")}, false},
        {{host("farol:8080"), origin("http://evil.example"), origin("http://farol:8080")}, false},
        {{host("farol:8080"), origin("http://evil.example"), site("same-origin")}, false},
        {{host("farol:8080"), origin("http://farol:8080"), site("cross-site")}, false},
        {{host("farol:8080"), site("cross-site")}, false},
        {{host("farol:8080"), site("same-site")}, false},
        {{host("farol:8080"), site("other")}, false},
        {{host("farol:8080"), site("")}, false},
        {{host("farol:8080"), site("same-origin"), site("cross-site")}, false},
        {{host("evil.example"), origin("http://farol:8080")}, false},
    };
    for (const Row& row : table) {
        std::string text;
        for (const auto& [name, value] : row.headers) text += name + ": " + value + " | ";
        INFO(text);
        const Answer answer = post(server.port(), row.headers);
        if (row.passes) {
            CHECK((answer.status == 201 || answer.status == 200));
            continue;
        }
        CHECK(answer.status == 403);
        CHECK(answer.code() == "http.cross-site");
        // Reading is a page's right, as far as its browser shows it the answer.
        for (const char* method : {"GET", "HEAD"})
            CHECK(send(server.port(), {method, "/v1/scenes", "1.1", row.headers}).status == 200);
        CHECK(send(server.port(), {"OPTIONS", "/v1/scenes", "1.1", row.headers}).status == 204);
        for (const char* method : {"DELETE", "PUT", "PATCH"})
            CHECK(send(server.port(), {method, "/v1/scenes/~0", "1.1", row.headers}).status == 403);
    }
    CHECK(server.backend.renders == 0);
}

TEST_CASE("the body of a refused request is not waited for") {
    FakeServer server;
    RawClient client(server.port());
    client.send(
        "POST /v1/scenes HTTP/1.1\r\nHost: farol\r\nOrigin: http://evil.example\r\n"
        "Expect: 100-continue\r\nContent-Type: text/xml\r\nContent-Length: 1000\r\n\r\n");
    CHECK(client.read().status == 403);
    CHECK(client.closedByServer());
}

TEST_CASE("an origin that --cors names may change things, and no other") {
    const Headers own = {{"Host", "farol"}};
    const auto with = [&](const std::string& origin) {
        Headers headers = own;
        if (!origin.empty()) headers.emplace_back("Origin", origin);
        headers.emplace_back("Sec-Fetch-Site", "cross-site");
        return headers;
    };
    server::ServiceOptions options;
    options.corsOrigin = "https://page.example";
    FakeServer named(options);
    CHECK(post(named.port(), with("https://page.example")).status == 201);
    CHECK(post(named.port(), with("https://page.example:443")).status == 200);
    for (const char* origin : {"", "null", "http://page.example", "https://page.example:444",
                               "https://sub.page.example", "http://farol"})
        CHECK(post(named.port(), with(origin)).status == 403);
    options.corsOrigin = "*";
    FakeServer open(options);
    for (const char* origin : {"", "null", "https://other.example"})
        CHECK(post(open.port(), with(origin)).status / 100 == 2);
    options.corsOrigin = "page.example";
    FakeBackend backend;
    CHECK_THROWS_AS(TestServer(backend, options, anyPort()), Error);
}

TEST_CASE("a foreign or missing Host is refused, but for health checks") {
    server::ServiceOptions options;
    options.allowedHosts = {"localhost", "127.0.0.1", "[::1]", "farol.example:8080"};
    FakeServer server(options);
    struct Row {
        std::string target, version;
        Headers headers;
        int status;
        std::string code;
    };
    const std::vector<Row> table = {
        {"/version", "1.1", {{"Host", "localhost"}}, 200, ""},
        {"/version", "1.1", {{"Host", "localhost:1"}}, 200, ""},
        {"/version", "1.1", {{"Host", "LOCALHOST.:8080"}}, 200, ""},
        {"/version", "1.1", {{"Host", "127.0.0.1:8080"}}, 200, ""},
        {"/version", "1.1", {{"Host", "[0:0:0:0:0:0:0:1]"}}, 200, ""},
        {"/version", "1.1", {{"Host", "farol.example:8080"}}, 200, ""},
        {"/version", "1.1", {{"Host", "farol.example"}}, 421, "http.host-unknown"},
        {"/version", "1.1", {{"Host", "farol.example:80"}}, 421, "http.host-unknown"},
        {"/version", "1.1", {{"Host", "rebound.example"}}, 421, "http.host-unknown"},
        {"/version", "1.1", {{"Host", "localhost.rebound.example"}}, 421, "http.host-unknown"},
        {"/version", "1.1", {{"Host", "127.0.0.2"}}, 421, "http.host-unknown"},
        {"/version", "1.1", {{"Host", "[::2]:8080"}}, 421, "http.host-unknown"},
        {"/version", "1.1", {}, 400, "http.host"},
        {"/version", "1.1", {{"Host", ""}}, 400, "http.host"},
        {"/version", "1.1", {{"Host", "local host"}}, 400, "http.host"},
        {"/version", "1.1", {{"Host", "user@localhost"}}, 400, "http.host"},
        {"/version", "1.1", {{"Host", "::1"}}, 400, "http.host"},
        {"/version", "1.1", {{"Host", "localhost"}, {"Host", "localhost"}}, 400, "http.host"},
        {"/version", "1.1", {{"Host", "localhost"}, {"host", "evil"}}, 400, "http.host"},
        {"/version", "1.1", {{"Host", ""}, {"Host", "localhost"}}, 400, "http.host"},
        {"/version", "1.0", {}, 200, ""},
        {"/version", "1.0", {{"Host", "localhost"}}, 200, ""},
        {"/version", "1.0", {{"Host", "rebound.example"}}, 421, "http.host-unknown"},
        // Where the target is absolute, its host counts (RFC 9112 section 3.2.2).
        {"http://localhost/version", "1.1", {{"Host", "evil"}}, 200, ""},
        {"HTTP://localhost:9/version", "1.1", {{"Host", "localhost"}}, 200, ""},
        {"http://evil/version", "1.1", {{"Host", "localhost"}}, 421, "http.host-unknown"},
        {"http://localhost/version", "1.1", {}, 400, "http.host"},
        {"http://evil/livez", "1.1", {{"Host", "localhost"}}, 200, ""},
        {"/livez", "1.1", {{"Host", "10.1.2.3:8080"}}, 200, ""},
        {"/readyz", "1.1", {{"Host", "rebound.example"}}, 200, ""},
        {"/livez", "1.1", {}, 200, ""},
        {"/livez", "1.1", {{"Host", "a"}, {"Host", "a"}}, 400, "http.host"},
        {"/livez/x", "1.1", {{"Host", "evil"}}, 421, "http.host-unknown"},
        {"/metrics", "1.1", {{"Host", "evil"}}, 421, "http.host-unknown"},
        {"/", "1.1", {{"Host", "evil"}}, 421, "http.host-unknown"},
    };
    for (const Row& row : table) {
        INFO(row.target << " HTTP/" << row.version
                        << (row.headers.empty() ? "" : " " + row.headers.front().second));
        const Answer answer = send(server.port(), {"GET", row.target, row.version, row.headers});
        CHECK(answer.status == row.status);
        CHECK(answer.code() == row.code);
    }
    for (const char* method : {"POST", "DELETE", "OPTIONS"})
        CHECK(send(server.port(), {method, "/v1/scenes", "1.1", {{"Host", "evil"}}}).status == 421);
    CHECK(send(server.port(), {"GET", "/v1/scenes/a/image?onerror=image", "1.1", {{"Host", "b"}}})
              .header("content-type") == "application/problem+json");
    options.allowedHosts = {"*", "localhost"};
    FakeServer open(options);
    CHECK(send(open.port(), {"GET", "/version", "1.1", {{"Host", "any"}}}).status == 200);
    CHECK(send(open.port(), {"GET", "/version", "1.1", {}}).status == 400);
    options.allowedHosts = {"http://farol"};
    FakeBackend backend;
    CHECK_THROWS_AS(TestServer(backend, options, anyPort()), Error);
}
