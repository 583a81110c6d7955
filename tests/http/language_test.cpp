#include <catch2/catch.hpp>

#include "fixture.h"
#include "server/messages.h"
#include "tests/support/paths.h"

// Accept-Language: the texts of problem documents and diagnostics, and what caches must know.
using namespace farol;
using namespace farol::test;

namespace {

using Headers = std::vector<std::pair<std::string, std::string>>;

Headers in(const char* language) { return {{"Accept-Language", language}}; }

/// A diagnostic as a worker sends it.
Diagnostics oneWarning() {
    Message message;
    message.id = "scene.empty-value";
    message.text = "English";
    message.arguments = {{"name", "y", ""}, {"element", "scale", ""}};
    return {diagnosticOf(Severity::warning, std::move(message), {"scene.xml", 3, 1})};
}

}  // namespace

TEST_CASE("problem documents are in the language that the client accepts") {
    FakeServer server;
    const Answer english = get(server.port(), "/v1/scenes/none");
    CHECK(english.header("content-language") == "en");
    CHECK(english.header("vary") == "Accept-Language");
    struct Case {
        const char *header, *language, *detail;
    };
    for (const Case& one : {Case{"pt-PT, en;q=0.5", "pt", "não há aqui nenhuma cena"},
                            Case{"es", "es", "aquí no hay ninguna escena"},
                            Case{"cs", "cs", "tu není"}, Case{"de, fr;q=0.5", "en", "no scene"}}) {
        const Answer answer = get(server.port(), "/v1/scenes/none", in(one.header));
        INFO(answer.body);
        CHECK(answer.status == english.status);
        CHECK(answer.code() == english.code());
        CHECK(answer.header("content-language") == one.language);
        CHECK(answer.header("vary") == "Accept-Language");
        CHECK_THAT(answer.json()["detail"].get<std::string>(), Catch::Contains(one.detail));
        CHECK(answer.json()["errors"][0]["message"] == answer.json()["detail"]);
        CHECK(answer.json()["title"] == english.json()["title"]);
    }
}

TEST_CASE("diagnostics of a valid scene are translated, and images do not vary by language") {
    FakeServer server;
    server.backend.onInspect = [](const render::Job&) {
        render::SceneReport report;
        report.diagnostics = oneWarning();
        return report;
    };
    Ask request{"POST", "/v1/validate", {{"Content-Type", "application/xml"}}, "<world/>"};
    CHECK(ask(server.port(), request).json()["diagnostics"][0]["message"] == "English");
    request.headers.emplace_back("Accept-Language", "pt");
    const Answer report = ask(server.port(), request);
    CHECK(report.header("content-language") == "pt");
    CHECK(report.json()["diagnostics"][0]["message"] ==
          "\"y\" de <scale> está vazio; usa-se o valor por omissão");
    CHECK(report.json()["diagnostics"][0]["code"] == "scene.empty-value");

    request.target = "/v1/render?width=8&height=8";
    const Answer image = ask(server.port(), request);
    CHECK(image.status == 200);
    CHECK(image.header("content-language").empty());
    CHECK(image.header("vary") == "Accept");
    CHECK(image.header("etag") == post(server.port(), request.target, request.body).header("etag"));
}

TEST_CASE("a list of scenes has a tag for each language") {
    server::ServiceOptions options;
    options.scenesDir = std::string(kSourceDir) + "/scenes";
    FakeServer server(options);
    const Answer english = get(server.port(), "/v1/scenes");
    const Answer czech = get(server.port(), "/v1/scenes", in("cs"));
    CHECK(czech.header("content-language") == "cs");
    CHECK(czech.header("vary") == "Accept-Language");
    CHECK(czech.header("etag") != english.header("etag"));
    Headers again = in("cs");
    again.emplace_back("If-None-Match", czech.header("etag"));
    const Answer same = get(server.port(), "/v1/scenes", again);
    CHECK(same.status == 304);
    CHECK(same.header("vary") == "Accept-Language");
    again[0].second = "en";
    CHECK(get(server.port(), "/v1/scenes", again).status == 200);
}
