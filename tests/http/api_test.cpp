// The answer of each route, with a stand-in for the renderer.
#include <catch2/catch.hpp>
#include <condition_variable>
#include <thread>

#include "fixture.h"
#include "tests/support/errors.h"

using namespace farol;
using namespace farol::test;

namespace {

struct Row {
    const char* name;
    Ask ask;
    int status;
    const char* code;   ///< of the problem; "" for success
    const char* field;  ///< named by the first error; "" for none
};

Ask rendering(std::string query, std::string type = "application/xml",
              std::string body = "<world/>") {
    return {"POST", "/v1/render" + query, {{"Content-Type", std::move(type)}}, std::move(body)};
}

std::string shell(const TemporaryFolder& folder) {
    folder.write("box/scene.xml", "<world>box</world>");
    folder.write("box/wood.png", "not looked at");
    folder.write("plain.xml", "<world>plain</world>");
    folder.write("deep/er/one.xml", "<world>one</world>");
    folder.write("with blank & \xC3\xA9.xml", "<world/>");
    folder.write("notes.txt", "no scene");
    return folder.path();
}

}  // namespace

TEST_CASE("every request has its status and its code") {
    const TemporaryFolder folder("http-table");
    server::ServiceOptions options;
    options.scenesDir = shell(folder);
    FakeServer server(options);
    const std::string twoScenes =
        multipart({{"scene", "a.xml", "<world/>", ""}, {"scene", "b.xml", "<world/>", ""}});
    const std::vector<Row> table = {
        {"page", {"GET", "/", {}, ""}, 200, "", ""},
        {"plain page", {"GET", "/plain", {}, ""}, 200, "", ""},
        {"script", {"GET", "/assets/plain.js", {}, ""}, 200, "", ""},
        {"style", {"GET", "/assets/plain.css", {}, ""}, 200, "", ""},
        {"no such asset", {"GET", "/assets/app.js", {}, ""}, 404, "http.not-found", ""},
        {"openapi", {"GET", "/openapi.yaml", {}, ""}, 200, "", ""},
        {"livez", {"GET", "/livez", {}, ""}, 200, "", ""},
        {"readyz", {"GET", "/readyz", {}, ""}, 200, "", ""},
        {"version", {"GET", "/version", {}, ""}, 200, "", ""},
        {"metrics", {"GET", "/metrics", {}, ""}, 200, "", ""},
        {"metrics with a parameter", {"GET", "/metrics?x=1", {}, ""}, 400, "option.unknown", "x"},
        {"list", {"GET", "/v1/scenes", {}, ""}, 200, "", ""},
        {"one", {"GET", "/v1/scenes/box", {}, ""}, 200, "", ""},
        {"one in a folder", {"GET", "/v1/scenes/deep/er/one", {}, ""}, 200, "", ""},
        {"escaped slash", {"GET", "/v1/scenes/deep%2Fer%2Fone/image", {}, ""}, 200, "", ""},
        {"escaped name", {"GET", "/v1/scenes/with%20blank%20%26%20%C3%A9", {}, ""}, 200, "", ""},
        {"source", {"GET", "/v1/scenes/plain/source", {}, ""}, 200, "", ""},
        {"image", {"GET", "/v1/scenes/box/image?width=64", {}, ""}, 200, "", ""},
        {"thumbnail", {"GET", "/v1/scenes/box/thumbnail", {}, ""}, 200, "", ""},
        {"shapes", {"GET", "/v1/primitives", {}, ""}, 200, "", ""},
        {"a shape", {"GET", "/v1/primitives/cone?args=1,2,4,3", {}, ""}, 200, "", ""},
        {"HEAD", {"HEAD", "/v1/scenes/box/image", {}, ""}, 200, "", ""},
        {"OPTIONS", {"OPTIONS", "/v1/render", {}, ""}, 204, "", ""},
        {"render", rendering(""), 200, "", ""},
        {"render text/xml", rendering("", "text/xml; charset=utf-8"), 200, "", ""},
        {"validate", {"POST", "/v1/validate", {}, "<world/>"}, 200, "", ""},

        {"nothing there", {"GET", "/nowhere", {}, ""}, 404, "http.not-found", ""},
        {"no such scene", {"GET", "/v1/scenes/nope", {}, ""}, 404, "http.not-found", ""},
        {"no such image", {"GET", "/v1/scenes/nope/image", {}, ""}, 404, "http.not-found", ""},
        {"no such shape", {"GET", "/v1/primitives/dodo", {}, ""}, 404, "http.not-found", ""},
        {"no scene", {"GET", "/v1/scenes/notes", {}, ""}, 404, "http.not-found", ""},
        {"up", {"GET", "/v1/scenes/../box/source", {}, ""}, 404, "http.not-found", ""},
        {"up, escaped",
         {"GET", "/v1/scenes/%2e%2e%2fbox/source", {}, ""},
         404,
         "http.not-found",
         ""},
        {"up, deep",
         {"GET", "/v1/scenes/deep/../../../etc/source", {}, ""},
         404,
         "http.not-found",
         ""},
        {"absolute",
         {"GET", "/v1/scenes/%2Fetc%2Fpasswd/source", {}, ""},
         404,
         "http.not-found",
         ""},
        {"backslashes", {"GET", "/v1/scenes/..%5Cbox/source", {}, ""}, 404, "http.not-found", ""},
        {"POST on a GET", {"POST", "/v1/scenes/box", {}, "x"}, 405, "http.method", ""},
        {"GET on a POST", {"GET", "/v1/render", {}, ""}, 405, "http.method", ""},
        {"PUT", {"PUT", "/v1/scenes/box", {}, "x"}, 405, "http.method", ""},
        {"DELETE", {"DELETE", "/v1/scenes/box", {}, ""}, 405, "http.method", ""},
        {"TRACE", {"TRACE", "/livez", {}, ""}, 405, "http.method", ""},
        {"not acceptable",
         {"GET", "/v1/scenes/box/image", {{"Accept", "text/html"}}, ""},
         406,
         "http.not-acceptable",
         ""},
        {"format against Accept",
         {"GET", "/v1/scenes/box/image?format=jpeg", {{"Accept", "image/png"}}, ""},
         406,
         "http.not-acceptable",
         ""},
        {"empty body", rendering("", "application/xml", ""), 400, "xml.empty", ""},
        {"form from curl", rendering("", "application/x-www-form-urlencoded"), 415,
         "http.media-type", ""},
        {"JSON", rendering("", "application/json"), 415, "http.media-type", ""},
        {"no boundary", rendering("", "multipart/form-data"), 400, "http.multipart", ""},
        {"no multipart", rendering("", kMultipartType, "hello"), 400, "http.multipart", ""},
        {"cut multipart", rendering("", kMultipartType, twoScenes.substr(0, 80)), 400,
         "http.multipart", ""},
        {"two scenes", rendering("", kMultipartType, twoScenes), 400, "http.multipart", ""},
        {"no scene part", rendering("", kMultipartType, multipart({{"x", "a.png", "p", ""}})), 400,
         "bundle.no-scene", "scene"},
        {"a mesh alone", rendering("", kMultipartType, multipart({{"x", "a.obj", "v", ""}})), 400,
         "bundle.no-scene", "scene"},
        {"two documents, none called scene",
         rendering("", kMultipartType,
                   multipart({{"x", "a.xml", "p", ""}, {"y", "b.xml", "p", ""}})),
         400, "bundle.which-scene", "scene"},
        {"zip", rendering("", "application/zip", "PK\3\4..."), 200, "", ""},
        {"gzip", rendering("", "application/gzip", "\x1f\x8b..."), 200, "", ""},
        {"zip without a type", rendering("", "application/octet-stream", "PK\3\4..."), 200, "", ""},
        {"zip as part scene",
         rendering("", kMultipartType, multipart({{"scene", "s.zip", "PK\3\4...", ""}})), 200, "",
         ""},
        {"zip beside files",
         rendering("", kMultipartType,
                   multipart({{"scene", "s.zip", "PK\3\4...", ""}, {"f", "a.png", "x", ""}})),
         400, "http.multipart", ""},
        {"no zip", rendering("", "application/zip", "<world/>"), 400, "bundle.damaged", ""},
        {"something", rendering("", "application/octet-stream", "<world/>"), 415, "http.media-type",
         ""},
        {"file name up",
         rendering("", kMultipartType,
                   multipart({{"scene", "s.xml", "<world/>", ""}, {"f", "../../etc/x", "p", ""}})),
         400, "http.multipart", ""},
        {"file name absolute",
         rendering("", kMultipartType,
                   multipart({{"scene", "s.xml", "<world/>", ""}, {"f", "/etc/x", "p", ""}})),
         400, "http.multipart", ""},
        {"options no JSON",
         rendering("", kMultipartType,
                   multipart({{"scene", "s.xml", "<world/>", ""}, {"options", "", "{", ""}})),
         400, "option.syntax", "options"},
        {"options unknown",
         rendering(
             "", kMultipartType,
             multipart({{"scene", "s.xml", "<w/>", ""}, {"options", "", "{\"wdth\":1}", ""}})),
         400, "option.unknown", "wdth"},
        {"width 0", rendering("?width=0"), 400, "option.range", "width"},
        {"width 100000", rendering("?width=100000"), 400, "option.range", "width"},
        {"width nan", rendering("?width=nan"), 400, "option.range", "width"},
        {"width blank", rendering("?width="), 400, "option.range", "width"},
        {"fov 0", rendering("?fov=0"), 400, "option.range", "fov"},
        {"fov nan", rendering("?fov=nan"), 400, "option.range", "fov"},
        {"eye inf", rendering("?eye=inf,0,0"), 400, "option.range", "eye"},
        {"shading", rendering("?shading=pretty"), 400, "option.range", "shading"},
        {"unknown", rendering("?colour=red"), 400, "option.unknown", "colour"},
        {"unknown on an image",
         {"GET", "/v1/scenes/box/image?widht=3", {}, ""},
         400,
         "option.unknown",
         "widht"},
        {"twice", rendering("?width=3&width=4"), 400, "option.repeated", "width"},
        {"strict", rendering("?strict=maybe"), 400, "option.range", "strict"},
        {"picture option on validate",
         {"POST", "/v1/validate?width=3", {}, "<world/>"},
         400,
         "option.unknown",
         "width"},
        {"parameter on livez", {"GET", "/livez?x=1", {}, ""}, 400, "option.unknown", "x"},
        {"page 0", {"GET", "/v1/scenes?page=0", {}, ""}, 400, "option.range", "page"},
        {"page beyond", {"GET", "/v1/scenes?page=2", {}, ""}, 400, "option.range", "page"},
        {"mesh format",
         {"GET", "/v1/primitives/cone?format=stl", {}, ""},
         400,
         "option.range",
         "format"},
    };
    for (const Row& row : table) {
        INFO(row.name);
        const Answer answer = ask(server.port(), row.ask);
        CHECK(answer.status == row.status);
        CHECK(answer.header("x-content-type-options") == "nosniff");
        CHECK_FALSE(answer.header("x-request-id").empty());
        CHECK_FALSE(answer.header("content-security-policy").empty());
        if (answer.status < 400) continue;
        CHECK(answer.header("content-type") == "application/problem+json");
        const auto problem = answer.json();
        REQUIRE(problem.is_object());
        CHECK(problem.value("code", "") == row.code);
        CHECK(problem.value("status", 0) == row.status);
        CHECK(problem.value("requestId", "") == answer.header("x-request-id"));
        for (const char* name : {"type", "title", "detail"})
            CHECK_FALSE(problem.value(name, "").empty());
        REQUIRE(problem["errors"].is_array());
        REQUIRE_FALSE(problem["errors"].empty());
        CHECK(problem["errors"][0].value("field", "") == row.field);
        CHECK(answer.closed);
    }
}

TEST_CASE("a wrong option is named with its range, and all of them at once") {
    FakeServer server;
    const Answer answer = ask(server.port(), rendering("?width=0&fov=400&colour=red"));
    const auto problem = answer.json();
    REQUIRE(problem["errors"].size() == 3);
    const std::string first = problem["errors"][0]["message"];
    CHECK(first.find("width") != std::string::npos);
    CHECK(first.find("1 to 4096") != std::string::npos);
    const Answer near = ask(server.port(), rendering("?widht=100"));
    CHECK(near.json().value("detail", "").find("\"width\"") != std::string::npos);
}

TEST_CASE("the methods of a path are reported") {
    FakeServer server;
    CHECK(get(server.port(), "/v1/render").header("allow") == "POST, OPTIONS");
    CHECK(post(server.port(), "/livez", "x").header("allow") == "GET, HEAD, OPTIONS");
    CHECK(ask(server.port(), {"OPTIONS", "/livez", {}, ""}).header("allow") ==
          "GET, HEAD, OPTIONS");
    // Also without a body, and so without a length: what is wrong is the method.
    for (const char* method : {"PUT", "PATCH", "POST", "DELETE"}) {
        INFO(method);
        const auto bodyless = [&](const std::string& path) {
            RawClient client(server.port());
            client.send(std::string(method) + " " + path + " HTTP/1.1\r\nHost: x\r\n\r\n");
            return client.read();
        };
        const Answer known = bodyless("/livez");
        CHECK(known.status == 405);
        CHECK(known.code() == "http.method");
        CHECK(known.header("allow") == "GET, HEAD, OPTIONS");
        CHECK(bodyless("/nothing").status == 404);
    }
}

TEST_CASE("picture options reach the job: preset, then options part, then query") {
    FakeServer server;
    render::Job seen;
    server.backend.onRender = [&](const render::Job& job) {
        seen = job;
        return render::Picture{};
    };
    const std::string body = multipart(
        {{"scene", "my scene.xml", "<world/>", "text/xml"},
         {"file", "textures/wood.png", "bytes of wood", "image/png"},
         {"options", "", R"({"width": 10, "height": 20, "eye": [1, 2.5, -3], "axes": true})", ""}});
    const Answer answer =
        ask(server.port(), rendering("?width=99&strict=1&shading=flat", kMultipartType, body));
    REQUIRE(answer.status == 200);
    CHECK(seen.name == "my scene.xml");
    CHECK(seen.xml == "<world/>");
    CHECK(seen.strict);
    CHECK(seen.options.width == 99);
    CHECK(seen.options.height == 20);
    CHECK(seen.options.eye == glm::dvec3(1, 2.5, -3));
    CHECK(seen.options.axes == true);
    CHECK(seen.options.shading == scene::Shading::flat);
    CHECK(seen.assets->read("textures/wood.png") == std::string("bytes of wood"));
}

TEST_CASE("the format follows the query, then Accept") {
    FakeServer server;
    const auto typeFor = [&](const std::string& query, const std::string& accept) {
        Ask request = rendering(query);
        if (!accept.empty()) request.headers.emplace_back("Accept", accept);
        return ask(server.port(), request).header("content-type");
    };
    CHECK(typeFor("", "") == "image/png");
    CHECK(typeFor("", "*/*") == "image/png");
    CHECK(typeFor("", "image/avif,image/webp,image/apng,*/*;q=0.8") == "image/webp");
    CHECK(typeFor("", "image/jpeg") == "image/jpeg");
    CHECK(typeFor("", "image/*;q=0.5, image/png;q=0.1") == "image/jpeg");
    CHECK(typeFor("?format=png", "image/webp,*/*;q=0.8") == "image/png");
    CHECK(typeFor("?format=jpeg", "") == "image/jpeg");
}

TEST_CASE("diagnostics come with line and column, infos stay out") {
    FakeServer server;
    server.backend.onRender = [](const render::Job& job) -> render::Picture {
        Diagnostics found;
        for (const Severity severity : {Severity::info, Severity::warning, Severity::error}) {
            Diagnostic one;
            one.severity = severity;
            one.code = "scene.of-severity-" + std::to_string(static_cast<int>(severity));
            one.where = {job.name, 3 + static_cast<int>(severity), 6};
            one.message = "odd \xFF byte";
            found.push_back(std::move(one));
        }
        throw Error(found);
    };
    const Answer answer = ask(server.port(), rendering(""));
    CHECK(answer.status == 422);
    const auto errors = answer.json()["errors"];
    REQUIRE(errors.size() == 2);
    CHECK(errors[0]["severity"] == "warning");
    CHECK(errors[1]["line"] == 5);
    CHECK(errors[1]["column"] == 6);
    CHECK(errors[1]["file"] == "scene.xml");
    CHECK(answer.code() == "scene.of-severity-2");
}

TEST_CASE("the families of codes have their statuses") {
    FakeServer server;
    std::string code;
    server.backend.onRender = [&](const render::Job&) -> render::Picture {
        throw test::errorOf(code, "message");
    };
    const std::vector<std::pair<const char*, int>> table = {
        {"option.range", 400},     {"xml.syntax", 400},      {"scene.empty", 422},
        {"asset.missing", 422},    {"shape.argument", 422},  {"mesh.index", 422},
        {"image.unreadable", 422}, {"limit.triangles", 422}, {"limit.body", 413}};
    for (const auto& [name, status] : table) {
        code = name;
        INFO(name);
        const Answer answer = ask(server.port(), rendering(""));
        CHECK(answer.status == status);
        CHECK(answer.code() == name);
    }
}

TEST_CASE("an entity tag is known before anything is drawn") {
    const TemporaryFolder folder("http-etag");
    server::ServiceOptions options;
    options.scenesDir = shell(folder);
    FakeServer server(options);
    const auto tagOf = [&](const std::string& target) {
        return get(server.port(), target).header("etag");
    };
    const std::string image = "/v1/scenes/box/image?width=64&height=32";
    const std::string tag = tagOf(image);
    REQUIRE(tag.size() > 2);
    CHECK(tag.front() == '"');
    const int drawn = server.backend.renders;
    for (const std::string& match : {tag, "W/" + tag, "\"other\", " + tag, std::string("*")}) {
        const Answer answer = get(server.port(), image, {{"If-None-Match", match}});
        CHECK(answer.status == 304);
        CHECK(answer.header("etag") == tag);
        CHECK(answer.body.empty());
        CHECK(answer.header("content-length").empty());
    }
    CHECK(server.backend.renders == drawn);
    CHECK(get(server.port(), image, {{"If-None-Match", "\"other\""}}).status == 200);

    CHECK(tagOf("/v1/scenes/box/image?height=32&width=64") == tag);  // the order says nothing
    CHECK(tagOf("/v1/scenes/box/image?width=65&height=32") != tag);
    CHECK(tagOf(image + "&strict=1") != tag);
    CHECK(get(server.port(), image, {{"Accept", "image/webp"}}).header("etag") != tag);
    server.backend.name = "fake 2";
    CHECK(tagOf(image) != tag);
    server.backend.name = "fake 1";
    CHECK(tagOf(image) == tag);
    folder.write("box/wood.png", "another picture");
    const std::string afterAsset = tagOf(image);
    CHECK(afterAsset != tag);
    folder.write("box/scene.xml", "<world>bax</world>");
    CHECK(tagOf(image) != afterAsset);

    for (const char* other : {"/", "/v1/scenes", "/v1/scenes/box", "/v1/scenes/box/source",
                              "/v1/primitives", "/v1/primitives/cone?args=1,2,3,4"}) {
        const std::string its = tagOf(other);
        INFO(other);
        REQUIRE_FALSE(its.empty());
        CHECK(get(server.port(), other, {{"If-None-Match", its}}).status == 304);
    }
}

TEST_CASE("the folder is listed: ids, facts, and what cannot be read") {
    const TemporaryFolder folder("http-list");
    server::ServiceOptions options;
    options.scenesDir = shell(folder);
    FakeServer server(options);
    server.backend.onInspect = [](const render::Job& job) {
        if (job.xml == "<world>plain</world>")
            throw test::errorOf("xml.syntax", "broken here", {job.name, 1, 9});
        render::SceneReport report;
        report.title = "Box";
        report.animated = true;
        return report;
    };
    const auto list = get(server.port(), "/v1/scenes").json();
    REQUIRE(list["scenes"].size() == 4);
    CHECK(list["total"] == 4);
    std::vector<std::string> ids;
    for (const auto& one : list["scenes"]) ids.push_back(one["id"]);
    CHECK(ids == std::vector<std::string>{"box", "deep/er/one", "plain", "with blank & \xC3\xA9"});
    CHECK(list["scenes"][0]["title"] == "Box");
    CHECK(list["scenes"][0]["animated"] == true);
    CHECK(list["scenes"][0]["valid"] == true);
    CHECK(list["scenes"][0]["links"]["image"] == "/v1/scenes/box/image");
    CHECK(list["scenes"][2]["valid"] == false);
    CHECK(list["scenes"][2]["diagnostics"][0]["line"] == 1);
    CHECK(list["scenes"][2]["title"] == "plain");
    for (const auto& one : list["scenes"])
        CHECK(get(server.port(), one["links"]["self"]).status == 200);

    const int seen = server.backend.inspections;
    get(server.port(), "/v1/scenes");
    CHECK(server.backend.inspections == seen);  // known until a file changes
    folder.write("plain.xml", "<world>changed</world>");
    CHECK(get(server.port(), "/v1/scenes").json()["scenes"][2]["valid"] == true);
    CHECK(get(server.port(), "/v1/scenes/plain/source").body == "<world>changed</world>");
}

TEST_CASE("more scenes than a page holds are paged") {
    const TemporaryFolder folder("http-pages");
    for (int i = 0; i < 120; ++i)
        folder.write("s" + std::to_string(1000 + i) + "/scene.xml", "<world/>");
    server::ServiceOptions options;
    options.scenesDir = folder.path();
    FakeServer server(options);
    const auto last = get(server.port(), "/v1/scenes?page=3").json();
    CHECK(last["pages"] == 3);
    CHECK(last["total"] == 120);
    CHECK(last["scenes"].size() == 20);
    CHECK(last["scenes"][19]["id"] == "s1119");
}

TEST_CASE("request ids are kept when well-formed") {
    FakeServer server;
    const auto idFor = [&](const std::string& wish) {
        return get(server.port(), "/livez", {{"X-Request-Id", wish}}).header("x-request-id");
    };
    CHECK(idFor("abc-1.2_3") == "abc-1.2_3");
    CHECK(idFor("two words") != "two words");
    CHECK(idFor(std::string(65, 'a')).size() == 16);
}

TEST_CASE("each request is one line of JSON in the log") {
    FakeServer server;
    get(server.port(), "/v1/scenes/nope?x=\"quoted\"", {{"X-Request-Id", "logged"}});
    get(server.port(), "/livez");
    server.stop();  // a line is written once the answer is out
    bool found = false;
    for (const std::string& line : server.log()) {
        const auto entry = nlohmann::json::parse(line, nullptr, false);
        REQUIRE(entry.is_object());
        CHECK(line.find('\n') == std::string::npos);
        if (entry.value("requestId", "") != "logged") continue;
        found = true;
        CHECK(entry["status"] == 400);
        CHECK(entry["remote"] == "127.0.0.1");
        CHECK(entry["code"] == "option.unknown");
        CHECK(entry["ms"].is_number());
    }
    CHECK(found);
}

TEST_CASE("not ready is reported while alive") {
    FakeServer server;
    server.backend.onCheck = [] { throw std::runtime_error("wrong colours"); };
    const Answer answer = get(server.port(), "/readyz");
    CHECK(answer.status == 503);
    CHECK_FALSE(answer.header("retry-after").empty());
    CHECK(answer.body.find("wrong colours") == std::string::npos);
    CHECK(get(server.port(), "/livez").status == 200);
}

TEST_CASE("CORS headers are sent when asked for, and only then") {
    FakeServer closed;
    CHECK(get(closed.port(), "/livez").header("access-control-allow-origin").empty());
    server::ServiceOptions options;
    options.corsOrigin = "https://school.example";
    FakeServer open(options);
    CHECK(get(open.port(), "/livez").header("access-control-allow-origin") ==
          "https://school.example");
    const Answer preflight = ask(open.port(), {"OPTIONS", "/v1/render", {}, ""});
    CHECK(preflight.status == 204);
    CHECK(preflight.header("access-control-allow-methods").find("POST") != std::string::npos);
}
