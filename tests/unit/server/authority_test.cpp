#include "server/http/authority.h"

#include <catch2/catch.hpp>

#include "server/http/head.h"

using namespace farol::server::http;

TEST_CASE("hosts are compared in one spelling") {
    const std::vector<std::tuple<std::string, std::string, int>> valid = {
        {"farol.example", "farol.example", -1},
        {"FAROL.Example.:8080", "farol.example", 8080},
        {"farol:", "farol", -1},
        {"127.0.0.1:65535", "127.0.0.1", 65535},
        {"[::1]", "::1", -1},
        {"[0:0:0:0:0:0:0:1]:80", "::1", 80},
        {"[2001:DB8::0:1]:0", "2001:db8::1", 0},
        {"a_b-c~d%20", "a_b-c~d%20", -1},
    };
    for (const auto& [text, host, port] : valid) {
        INFO(text);
        const auto authority = parseAuthority(text);
        REQUIRE(authority);
        CHECK(authority->host == host);
        CHECK(authority->port.value_or(-1) == port);
    }
    for (const char* const text : {"",
                                   ".",
                                   ":80",
                                   "user@farol",
                                   "a:b",
                                   "a:1:2",
                                   "a:65536",
                                   "a:-1",
                                   "a: 1",
                                   "a b",
                                   "a/b",
                                   "::1",
                                   "[::1",
                                   "[::1]x",
                                   "[::1]:x",
                                   "[fe80::1%eth0]",
                                   "[127.0.0.1]",
                                   "a,b:1:",
                                   "a\"b",
                                   "\xc3\xa9"}) {
        INFO(text);
        CHECK_FALSE(parseAuthority(text));
    }
    CHECK_FALSE(parseAuthority(std::string(301, 'a')));
}

TEST_CASE("an IPv6 client has all addresses of its network") {
    CHECK(clientOfAddress("192.0.2.7") == "192.0.2.7");
    CHECK(clientOfAddress("2001:db8:1:2:3:4:5:6") == clientOfAddress("2001:db8:1:2::9"));
    CHECK(clientOfAddress("2001:db8:1:2::9") != clientOfAddress("2001:db8:1:3::9"));
    CHECK(clientOfAddress("::ffff:192.0.2.7") != clientOfAddress("::ffff:192.0.2.8"));
}

TEST_CASE("the authority of a request is its target's, else its Host") {
    const auto of = [](const std::string& text) { return checkHead(text + "\r\n"); };
    Head head = of("GET http://Other.example:81/a?b HTTP/1.1\r\nHost: farol\r\n");
    REQUIRE(head.request.authority);
    CHECK(head.request.authority->host == "other.example");
    CHECK(head.request.authority->port == 81);
    CHECK(head.request.path == "/a");
    CHECK(of("GET HTTPS://other HTTP/1.1\r\nHost: x\r\n").request.path == "/");
    CHECK(of("GET / HTTP/1.1\r\nHost: Farol:80\r\n").request.authority->host == "farol");
    CHECK(of("GET / HTTP/1.1\r\n").request.lacksHost);
    CHECK(of("GET / HTTP/1.1\r\nHost:\r\n").request.lacksHost);
    CHECK(of("GET http://farol/ HTTP/1.1\r\n").request.lacksHost);
    CHECK_FALSE(of("GET / HTTP/1.0\r\n").request.lacksHost);
    for (const char* target : {"http:///a", "http://u@farol/", "http://a b/", "http://[::1/"})
        CHECK(of(std::string("GET ") + target + " HTTP/1.1\r\nHost: x\r\n").refusal->status == 400);
}
