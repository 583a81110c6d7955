// Pages of other origins (Fetch Standard, "CORS protocol").
#include <catch2/catch.hpp>
#include <map>

#include "fixture.h"
#include "worker/messages.h"

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

TEST_CASE("only /embed may be framed, by the service itself and the origin of --cors") {
    const auto policyOf = [](const FakeServer& server, const char* path) {
        const Answer answer = get(server.port(), path);
        CHECK(answer.status == 200);
        const std::string policy = answer.header("content-security-policy");
        return policy.substr(policy.find("frame-ancestors"));
    };
    for (const auto& [origin, ancestors] : std::map<std::string, std::string>{
             {"", "frame-ancestors 'self'"},
             {"null", "frame-ancestors 'self'"},
             {"*", "frame-ancestors 'self' *"},
             {"https://moodle.example", "frame-ancestors 'self' https://moodle.example"}}) {
        INFO(origin);
        server::ServiceOptions options;
        options.corsOrigin = origin;
        FakeServer server(options);
        CHECK(policyOf(server, "/embed") == ancestors);
        for (const char* path : {"/", "/plain"})
            CHECK(policyOf(server, path) == "frame-ancestors 'none'");
        CHECK(get(server.port(), "/embed?x=1").status == 400);
    }
}

TEST_CASE("with superseded=empty a frame that a newer one overtook is empty, not an error") {
    const TemporaryFolder folder("http-superseded");
    folder.write("box.xml", "<world/>");
    server::ServiceOptions options;
    options.scenesDir = folder.path();
    FakeServer server(options);
    server.backend.onRender = [](const render::Job&) -> render::Picture {
        throw worker::Busy(worker::message<"busy.superseded">(), 0);
    };
    const std::string image = "/v1/scenes/box/image?session=a&seq=1";
    CHECK(get(server.port(), image).status == 409);
    CHECK(get(server.port(), image + "&superseded=problem").status == 409);
    const Answer empty = get(server.port(), image + "&superseded=empty");
    CHECK(empty.status == 204);
    CHECK(empty.body.empty());
    CHECK(empty.header("cache-control") == "no-store");
    CHECK(post(server.port(), "/v1/render?session=a&seq=1&superseded=empty", "<world/>",
               "application/xml")
              .status == 204);
    CHECK(get(server.port(), image + "&superseded=quietly").status == 400);
    // What is wrong otherwise stays an error.
    server.backend.onRender = [](const render::Job&) -> render::Picture {
        throw worker::Busy(worker::message<"busy.queue">(), 1);
    };
    CHECK(get(server.port(), image + "&superseded=empty").status == 503);
}
