// Scenes that are sent, kept, found, listed and deleted: with a stand-in for the renderer.
#include <catch2/catch.hpp>
#include <filesystem>
#include <thread>

#include "daemon.h"
#include "fixture.h"
#include "server/store/disk_store.h"
#include "server/store/memory_store.h"
#include "tests/support/archives.h"
#include "tests/support/errors.h"

using namespace farol;
using namespace farol::test;

namespace {

constexpr const char* kStore = "/v1/scenes";
const std::string kUnknown = "/v1/scenes/~00000000000000000000000000000000";

Ask storing(const std::string& query, const std::string& body,
            std::vector<std::pair<std::string, std::string>> more = {}) {
    more.emplace_back("Content-Type", "application/xml");
    return {"POST", kStore + query, std::move(more), body};
}

Ask deleting(const std::string& target,
             std::vector<std::pair<std::string, std::string>> headers = {}) {
    return {"DELETE", target, std::move(headers), ""};
}

}  // namespace

TEST_CASE("an upload is kept under its content's address and is like a served scene") {
    FakeServer server;
    const Answer first = ask(server.port(), storing("", "<world>1</world>"));
    REQUIRE(first.status == 201);
    const std::string at = first.header("location");
    CHECK(at.rfind("/v1/scenes/~", 0) == 0);
    const auto facts = first.json();
    CHECK("/v1/scenes/" + facts["id"].get<std::string>() == at);
    CHECK(facts["valid"] == true);
    CHECK(facts["upload"] == true);
    CHECK(facts["public"] == false);
    CHECK(facts["expires"].get<std::string>().size() == 20);
    CHECK(facts["links"]["image"] == at + "/image");

    const Answer again = ask(server.port(), storing("", "<world>1</world>"));
    CHECK(again.status == 200);
    CHECK(again.header("location") == at);
    CHECK(ask(server.port(), storing("", "<world>2</world>")).header("location") != at);

    CHECK(get(server.port(), at).json()["title"] == "Title of scene.xml");
    CHECK(get(server.port(), at + "/source").body == "<world>1</world>");
    CHECK(get(server.port(), at + "/thumbnail").status == 200);
    const Answer image = get(server.port(), at + "/image?width=64");
    CHECK(image.status == 200);
    const int drawn = server.backend.renders;
    CHECK(get(server.port(), at + "/image?width=64", {{"If-None-Match", image.header("etag")}})
              .status == 304);
    CHECK(server.backend.renders == drawn);

    CHECK(ask(server.port(), deleting(at)).status == 204);
    CHECK(ask(server.port(), deleting(at)).status == 404);
    for (const char* what : {"", "/source", "/image", "/thumbnail"})
        CHECK(get(server.port(), at + what).status == 404);
}

TEST_CASE("with base= a document takes the place of a scene's own, beside its files") {
    const TemporaryFolder folder("http-base");
    folder.write("box/scene.xml", "<world>old</world>");
    folder.write("box/tile.png", "pixels");
    server::ServiceOptions options;
    options.scenesDir = folder.path();
    FakeServer server(options);
    std::vector<render::Job> jobs;
    server.backend.onRender = [&](const render::Job& job) {
        jobs.push_back(job);
        return render::Picture{};
    };
    const auto rendering = [](const std::string& query, const std::string& body) {
        return Ask{"POST", "/v1/render" + query, {{"Content-Type", "application/xml"}}, body};
    };
    const Answer kept = ask(server.port(), storing("?base=box", "<world>new</world>"));
    REQUIRE(kept.status == 201);
    const std::string id = kept.json()["id"];
    for (const std::string& base : {std::string("box"), id}) {
        INFO(base);
        jobs.clear();
        CHECK(ask(server.port(), rendering("?base=" + base, "<world>1</world>")).status == 200);
        CHECK(ask(server.port(), rendering("?base=" + base, "<world>2</world>")).status == 200);
        REQUIRE(jobs.size() == 2);
        CHECK(jobs[0].xml == "<world>1</world>");
        CHECK(jobs[0].name == "scene.xml");
        CHECK(jobs[0].assets->read("tile.png") == "pixels");
        CHECK(jobs[0].identity != jobs[1].identity);
        CHECK(!jobs[0].identity.empty());
    }
    CHECK(get(server.port(), "/v1/scenes/" + id + "/source").body == "<world>new</world>");
    CHECK(get(server.port(), "/v1/scenes/box/source").body == "<world>old</world>");
    CHECK(ask(server.port(), rendering("?base=missing", "<world/>")).status == 404);
    CHECK(post(server.port(), "/v1/render?base=box", pack(Packing::zip, {{"a.xml", "<world/>"}}),
               "application/zip")
              .status == 400);
}

TEST_CASE("with base= files that are sent join, replace and leave out those of the scene") {
    const TemporaryFolder folder("http-base-files");
    folder.write("box/scene.xml", "<world>old</world>");
    folder.write("box/tile.png", "tile");
    folder.write("box/wood.png", "wood");
    server::ServiceOptions options;
    options.scenesDir = folder.path();
    FakeServer server(options);
    std::vector<render::Job> jobs;
    server.backend.onRender = [&](const render::Job& job) {
        jobs.push_back(job);
        return render::Picture{};
    };
    const std::string changed = multipart({{"scene", "a.xml", "<world>new</world>", ""},
                                           {"file", "t/new.png", "fresh", ""},
                                           {"file", "wood.png", "oak", ""},
                                           {"without", "", "tile.png\nscene.xml\n", ""}});
    CHECK(post(server.port(), "/v1/render?base=box", changed, kMultipartType).status == 200);
    CHECK(post(server.port(), "/v1/render?base=box",
               multipart({{"scene", "", "<world>new</world>", ""}}), kMultipartType)
              .status == 200);
    REQUIRE(jobs.size() == 2);
    CHECK(jobs[0].xml == "<world>new</world>");
    CHECK(jobs[0].name == "scene.xml");
    CHECK(jobs[0].assets->list() == std::vector<std::string>{"scene.xml", "t/new.png", "wood.png"});
    CHECK(jobs[0].assets->read("wood.png") == "oak");
    CHECK(jobs[1].assets->read("tile.png") == "tile");
    CHECK(jobs[0].identity != jobs[1].identity);
    const Answer kept = post(server.port(), "/v1/scenes?base=box", changed, kMultipartType);
    REQUIRE(kept.status == 201);
    const auto files = get(server.port(), kept.header("location") + "/files").json();
    CHECK(files["main"] == "scene.xml");
    CHECK(files["files"] == nlohmann::json::parse(R"([{"bytes": 18, "path": "scene.xml"},
        {"bytes": 5, "path": "t/new.png"}, {"bytes": 3, "path": "wood.png"}])"));
    const Answer alone = post(server.port(), "/v1/render", changed, kMultipartType);
    CHECK(alone.status == 400);
    CHECK(alone.json()["errors"][0]["field"] == "without");
}

TEST_CASE("the files of a scene are listed and sent; others beside it are not") {
    const TemporaryFolder folder("http-files");
    folder.write("box/scene.xml", "<world><model file=\"a.obj\"/><include file='b.xml'/></world>");
    folder.write("box/a.obj", "mtllib a.mtl");
    folder.write("box/a.mtl", "map_Kd my skin.png");
    folder.write("box/t/my skin.png", "skin");
    folder.write("box/b.xml", "<world><texture file=\"c.png\"/></world>");
    folder.write("box/c.png", "pixels");
    folder.write("box/solution.xml", "<world>secret</world>");
    folder.write("box/notes.txt", "secret");
    server::ServiceOptions options;
    options.scenesDir = folder.path();
    FakeServer server(options);
    const auto listed = get(server.port(), "/v1/scenes/box/files").json();
    std::vector<std::string> paths;
    for (const auto& one : listed["files"]) paths.push_back(one["path"]);
    CHECK(paths == std::vector<std::string>{"scene.xml", "a.mtl", "a.obj", "b.xml", "c.png",
                                            "t/my skin.png"});
    const Answer skin = get(server.port(), "/v1/scenes/box/file?path=t/my%20skin.png");
    CHECK(skin.status == 200);
    CHECK(skin.body == "skin");
    CHECK(skin.header("content-type") == "application/octet-stream");
    CHECK(skin.header("content-disposition") == "attachment; filename*=UTF-8''my%20skin.png");
    CHECK(get(server.port(), "/v1/scenes/box/file?path=t/my%20skin.png",
              {{"If-None-Match", skin.header("etag")}})
              .status == 304);
    for (const char* path : {"solution.xml", "notes.txt", "../box/scene.xml", "", "t"})
        CHECK(get(server.port(), "/v1/scenes/box/file?path=" + std::string(path)).status == 404);
    CHECK(get(server.port(), "/v1/scenes/none/files").status == 404);
}

TEST_CASE("the same files have the same address, however they are sent") {
    FakeServer server;
    const std::string parts =
        multipart({{"file", "t/a.png", "wood", ""}, {"scene", "", "<world/>", ""}});
    const std::string otherOrder =
        multipart({{"scene", "scene.xml", "<world/>", ""}, {"x", "t/a.png", "wood", ""}});
    const Answer a = post(server.port(), kStore, parts, kMultipartType);
    const Answer b = post(server.port(), kStore, otherOrder, kMultipartType);
    CHECK(a.status == 201);
    CHECK(b.status == 200);
    CHECK(a.header("location") == b.header("location"));
    CHECK(post(server.port(), kStore, "PK\3\4...", "application/zip").status == 201);
}

TEST_CASE("uploads are listed only when they are public") {
    const TemporaryFolder folder("http-store-list");
    folder.write("box.xml", "<world/>");
    folder.write("~00000000000000000000000000000000.xml", "<world/>");  // an upload's id
    server::ServiceOptions options;
    options.scenesDir = folder.path();
    FakeServer server(options);
    CHECK(get(server.port(), kUnknown).status == 404);
    CHECK(ask(server.port(), storing("", "<world>hidden</world>")).status == 201);
    CHECK(get(server.port(), kStore).json()["total"] == 1);
    const Answer shown = ask(server.port(), storing("?public=1", "<world>shown</world>"));
    CHECK(shown.status == 201);
    CHECK(shown.json()["public"] == true);
    const auto list = get(server.port(), kStore).json();
    REQUIRE(list["total"] == 2);
    CHECK(list["scenes"][0]["id"] == "box");
    CHECK(list["scenes"][0]["upload"] == false);
    CHECK(list["scenes"][1]["id"] == shown.json()["id"]);
    CHECK(ask(server.port(), storing("?public=1", "<world>hidden</world>")).status == 200);
    CHECK(get(server.port(), kStore).json()["total"] == 3);
}

TEST_CASE("what cannot be kept is refused") {
    const TemporaryFolder folder("http-store-refuse");
    folder.write("box.xml", "<world/>");
    server::ServiceOptions options;
    options.scenesDir = folder.path();
    options.maxBodyBytes = 10'000;
    options.store = std::make_shared<server::store::MemoryStore>(server::store::StoreLimits{5'000});
    FakeServer server(options);
    server.backend.onInspect = [](const render::Job& job) -> render::SceneReport {
        if (job.xml.find("bad") != std::string::npos)
            throw test::errorOf("scene.empty", "nothing there");
        return {};
    };
    const struct {
        Ask ask;
        int status;
        const char* code;
    } table[] = {
        {storing("", "<bad/>"), 422, "scene.empty"},
        {storing("", ""), 400, "xml.empty"},
        {storing("?public=2", "<world/>"), 400, "option.range"},
        {storing("?width=64", "<world/>"), 400, "option.unknown"},
        {storing("", std::string(6'000, ' ') + "<world/>"), 413, "limit.store"},
        {storing("", std::string(20'000, ' ')), 413, "limit.body"},
        {{"POST", kStore, {{"Content-Type", "text/plain"}}, "x"}, 415, "http.media-type"},
        {deleting("/v1/scenes/box"), 405, "http.method"},
        {deleting("/v1/scenes/nope"), 404, "http.not-found"},
        {deleting("/v1/scenes/~short"), 404, "http.not-found"},
        {deleting(kUnknown), 404, "http.not-found"},
    };
    for (const auto& row : table) {
        const Answer answer = ask(server.port(), row.ask);
        INFO(row.code << " " << answer.body);
        CHECK(answer.status == row.status);
        CHECK(answer.code() == row.code);
    }
    CHECK(ask(server.port(), deleting("/v1/scenes/box")).header("allow") == "GET, HEAD, OPTIONS");
    CHECK(get(server.port(), "/v1/scenes/box").status == 200);
}

TEST_CASE("with a token set, writing needs it and reading does not") {
    server::ServiceOptions options;
    options.token = "open sesame";
    FakeServer server(options);
    const std::vector<std::pair<std::string, std::string>> right = {
        {"Authorization", "bearer  open sesame"}};
    for (const std::string& wrong :
         {std::string(), std::string("Bearer"), std::string("Bearer open"),
          std::string("Bearer open sesame2"), std::string("Basic open sesame")}) {
        std::vector<std::pair<std::string, std::string>> headers;
        if (!wrong.empty()) headers.emplace_back("Authorization", wrong);
        INFO(wrong);
        const Answer answer = ask(server.port(), storing("", "<world/>", headers));
        CHECK(answer.status == 401);
        CHECK(answer.code() == "http.unauthorized");
        CHECK(answer.header("www-authenticate") == "Bearer realm=\"farol\"");
        CHECK(ask(server.port(), deleting(kUnknown, headers)).status == 401);
    }
    const Answer kept = ask(server.port(), storing("", "<world/>", right));
    REQUIRE(kept.status == 201);
    CHECK(get(server.port(), kept.header("location") + "/image").status == 200);
    CHECK(post(server.port(), "/v1/render", "<world/>").status == 200);
    CHECK(ask(server.port(), deleting(kept.header("location"), right)).status == 204);
    for (const std::string& line : server.log()) CHECK(line.find("sesame") == std::string::npos);
}

TEST_CASE("uploads outlive the daemon, whatever ends it") {
    const TemporaryFolder folder("http-store-daemon");
    const std::string scene =
        "<world><group><models><model file=\"box_2_1.3d\"/></models></group></world>";
    const std::string zip = pack(Packing::zip, {{"s/scene.xml", scene}, {"s/note.txt", "hello"}});
    const std::vector<std::string> arguments = {"--port", "0",      "--workers",
                                                "1",      "--data", folder.path() + "/data"};
    std::string at, picture;
    {
        Daemon daemon(arguments);
        const int port = portIn(daemon.firstLine());
        const Answer kept = post(port, kStore, zip, "application/zip");
        REQUIRE(kept.status == 201);
        at = kept.header("location");
        picture = get(port, at + "/image?width=64&height=64").body;
        CHECK(picture.size() > 100);
        daemon.signal(SIGKILL);
    }
    Daemon daemon(arguments);
    const int port = portIn(daemon.firstLine());
    CHECK(get(port, at + "/image?width=64&height=64").body == picture);
    CHECK(get(port, at + "/source").body == scene);
}

TEST_CASE("a full disk is reported, and nothing is lost or half there") {
    const TemporaryFolder folder("http-store-full");
    const std::string scene = "<world><group><models><model file=\"box_2_1.3d\"/></models></group>";
    // No file of this process may grow beyond 64 blocks of 1 KiB: what the disk says when it is
    // full.
    Daemon daemon({"--port", "0", "--workers", "1", "--data", folder.path() + "/data"},
                  {.fileBytes = 64 * 1024});
    const int port = portIn(daemon.firstLine());
    const Answer kept = post(port, kStore, scene + "</world>");
    REQUIRE(kept.status == 201);
    const Answer refused =
        post(port, kStore, scene + "<!--" + std::string(100'000, ' ') + "--></world>");
    CHECK(refused.status == 503);
    CHECK(refused.code() == "store.full");
    CHECK(!refused.header("retry-after").empty());
    CHECK(get(port, kept.header("location")).status == 200);
    CHECK(post(port, kStore, scene + "<!-- more --></world>").status == 201);
    namespace fs = std::filesystem;
    CHECK(fs::is_empty(folder.path() + "/data/new"));
    const fs::directory_iterator files(folder.path() + "/data/scenes");
    CHECK(std::distance(begin(files), end(files)) == 2);
}
