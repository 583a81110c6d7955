// Pages of other origins (Fetch Standard, "CORS protocol").
#include <catch2/catch.hpp>

#include "fixture.h"

using namespace farol;
using namespace farol::test;

TEST_CASE("pages of another origin may call where that is wanted, and only there") {
    const std::vector<std::pair<std::string, std::string>> wanted = {
        {"POST", "/v1/render"}, {"POST", "/v1/scenes"}, {"DELETE", "/v1/scenes/any"},
        {"GET", "/v1/scenes"},  {"POST", "/v1/grade"},
    };
    const auto preflight = [](int port, const std::string& method, const std::string& path) {
        return ask(port, {"OPTIONS",
                          path,
                          {{"Origin", "https://page.example"},
                           {"Access-Control-Request-Method", method},
                           {"Access-Control-Request-Headers", "authorization, content-type"}},
                          ""});
    };
    const auto hasCors = [](const Answer& answer) {
        for (const auto& [name, value] : answer.headers)
            if (name.rfind("access-control-", 0) == 0) return true;
        return false;
    };
    FakeServer closed;
    for (const auto& [method, path] : wanted) {
        CHECK_FALSE(hasCors(preflight(closed.port(), method, path)));
        CHECK_FALSE(hasCors(get(closed.port(), path, {{"Origin", "https://page.example"}})));
    }
    server::ServiceOptions options;
    options.corsOrigin = "https://page.example";
    options.token = "secret";
    FakeServer open(options);
    for (const auto& [method, path] : wanted) {
        INFO(method << " " << path);
        const Answer answer = preflight(open.port(), method, path);
        CHECK(answer.status == 204);  // without the token, which browsers keep back here
        CHECK(answer.body.empty());
        CHECK(answer.header("access-control-allow-origin") == "https://page.example");
        CHECK(answer.header("access-control-allow-methods").find(method) != std::string::npos);
        const std::string headers = answer.header("access-control-allow-headers");
        for (const char* name : {"Authorization", "Content-Type", "If-None-Match", "X-Request-Id"})
            CHECK(headers.find(name) != std::string::npos);
        CHECK(answer.header("access-control-allow-credentials").empty());
    }
    // A page must be able to read why it was refused, too.
    const Answer refused = post(open.port(), "/v1/scenes", "<world/>");
    CHECK(refused.status == 401);
    CHECK(refused.header("access-control-allow-origin") == "https://page.example");
    const std::string exposed = refused.header("access-control-expose-headers");
    for (const char* name : {"ETag", "Location", "Server-Timing", "X-Farol-Stats", "Retry-After"})
        CHECK(exposed.find(name) != std::string::npos);
}
