// The service below a base path, behind a proxy that keeps the path or removes it.
#include <catch2/catch.hpp>

#include "fixture.h"

using namespace farol;
using namespace farol::test;

namespace {

server::ServiceOptions below(const std::string& path) {
    server::ServiceOptions options;
    options.basePath = path;
    return options;
}

}  // namespace

TEST_CASE("page, links, Location and OpenAPI lie below the base path") {
    FakeServer server(below("/farol"));
    const int port = server.port();
    const Answer short_ = get(port, "/farol");
    CHECK(short_.status == 308);
    CHECK(short_.header("location") == "/farol/");

    for (const std::string page : {"/farol/", "/farol/plain"}) {
        INFO(page);
        const Answer html = get(port, page);
        REQUIRE(html.status == 200);
        // Everything that it loads is relative, and is there.
        int loaded = 0;
        for (std::size_t at = html.body.find("=\""); at != std::string::npos;
             at = html.body.find("=\"", at + 1)) {
            const std::string before = html.body.substr(at - 4, 4);
            if (before != "href" && before != " src") continue;
            const std::size_t end = html.body.find('"', at + 2);
            const std::string address = html.body.substr(at + 2, end - at - 2);
            if (address.starts_with("data:") || address == "./") continue;
            INFO(address);
            CHECK_FALSE(address.starts_with("/"));
            CHECK(get(port, "/farol/" + address).status == 200);
            ++loaded;
        }
        CHECK(loaded >= 2);
    }

    const Answer interface = get(port, "/farol/openapi.yaml");
    CHECK(interface.body.find("  - url: http://127.0.0.1:8080/farol\n") != std::string::npos);
    CHECK(get(port, "/farol/openapi.yaml", {{"If-None-Match", interface.header("etag")}}).status ==
          304);

    const Answer stored = post(port, "/farol/v1/scenes", "<world/>");
    REQUIRE(stored.status == 201);
    const std::string at = stored.header("location");
    CHECK(at.starts_with("/farol/v1/scenes/~"));
    const auto links = stored.json()["links"];
    for (const auto& [name, link] : links.items()) {
        INFO(name);
        CHECK(link.get<std::string>().starts_with(at));
        CHECK(get(port, link).status == 200);
    }
    CHECK(get(port, "/farol/v1/scenes").status == 200);
    CHECK(ask(port, {"DELETE", at, {}, ""}).status == 204);
}

TEST_CASE("probes and proxies that take the base path off ask without it") {
    FakeServer server(below("/a/b"));
    for (const char* path : {"/livez", "/a/b/livez", "/version", "/a/b/version", "/", "/a/b/"})
        CHECK(get(server.port(), path).status == 200);
    for (const char* path :
         {"/a/b/nothing", "/a/bc/version", "/a", "/a/version", "/a/b/a/b/version"})
        CHECK(get(server.port(), path).status == 404);
    // Bodies are read there, too, and the method is known.
    CHECK(post(server.port(), "/a/b/v1/validate", "<world/>").status == 200);
    CHECK(ask(server.port(), {"PUT", "/a/b/v1/scenes", {}, ""}).status == 405);
}

TEST_CASE("without a base path nothing stands before the paths") {
    FakeServer server;
    CHECK(post(server.port(), "/v1/scenes", "<world/>").header("location").starts_with("/v1/"));
    CHECK(get(server.port(), "/openapi.yaml").body.find("  - url: http://127.0.0.1:8080\n") !=
          std::string::npos);
    CHECK(get(server.port(), "/farol/version").status == 404);
}
