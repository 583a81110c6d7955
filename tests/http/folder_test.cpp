// The served folder at its worst: entries that are no scenes, scenes that end their workers, and a
// folder that goes away or is replaced.
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <map>

#include "fixture.h"
#include "real.h"
#include "tests/support/errors.h"
#include "tests/support/paths.h"
#include "worker/messages.h"
#include "worker/pool.h"

using namespace farol;
using namespace farol::test;
namespace fs = std::filesystem;

namespace {

std::map<std::string, nlohmann::json> rowsOf(int port) {
    const Answer answer = get(port, "/v1/scenes");
    INFO(answer.body);
    REQUIRE(answer.status == 200);
    const nlohmann::json list = answer.json();
    std::map<std::string, nlohmann::json> rows;
    for (const nlohmann::json& row : list["scenes"]) rows[row["id"]] = row;
    REQUIRE(rows.size() == list["total"].get<std::size_t>());
    return rows;
}

void makeSocket(const std::string& path) {
    const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    // Names of sockets are short: it is created from within the folder.
    const fs::path before = fs::current_path();
    fs::current_path(fs::path(path).parent_path());
    fs::path(path).filename().string().copy(address.sun_path, sizeof address.sun_path - 1);
    REQUIRE(bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    fs::current_path(before);
    close(fd);
}

server::ServiceOptions serving(const std::string& folder) {
    server::ServiceOptions options;
    options.scenesDir = folder;
    return options;
}

}  // namespace

TEST_CASE("an entry of the folder that is no scene is one bad row of the list") {
    const TemporaryFolder folder("folder-odd");
    const auto path = [&](const std::string& name) { return folder.path() + "/" + name; };
    folder.write("good.xml", "<world/>");
    folder.write("below/good/scene.xml", "<world/>");
    folder.write("named.xml/scene.xml", "<world/>");  // a folder with a scene, no bad one
    REQUIRE(mkfifo(path("pipe.xml").c_str(), 0600) == 0);
    fs::create_directories(path("directory/scene.xml"));
    fs::create_symlink("nowhere", path("dangling.xml"));
    fs::create_symlink("loop.xml", path("loop.xml"));
    fs::create_symlink("/etc/passwd", path("outside.xml"));
    fs::create_symlink("/etc", path("outside-folder"));
    makeSocket(path("socket.xml"));
    folder.write("huge.xml", "<world/>");
    fs::resize_file(path("huge.xml"), std::uintmax_t{1} << 40U);  // sparse
    folder.write("beside/scene.xml", "<world/>");
    folder.write("beside/huge.ply", "");
    fs::resize_file(path("beside/huge.ply"), std::uintmax_t{1} << 40U);
    folder.write("caf\xE9.xml", "<world/>");  // Latin-1

    FakeServer server(serving(folder.path()));
    const auto rows = rowsOf(server.port());
    const std::map<std::string, std::string> expected = {
        {"good", ""},
        {"below/good", ""},
        {"beside", ""},
        {"named.xml", ""},
        {"pipe", "asset.unreadable"},
        {"directory", "asset.unreadable"},
        {"dangling", "asset.unreadable"},
        {"loop", "asset.unreadable"},
        {"socket", "asset.unreadable"},
        {"huge", "limit.bytes"},
        {"caf\xEF\xBF\xBD", "asset.name"},
    };
    REQUIRE(rows.size() == expected.size());
    for (const auto& [id, code] : expected) {
        INFO(id);
        REQUIRE(rows.count(id) == 1);
        const nlohmann::json& row = rows.at(id);
        CHECK(row["valid"] == code.empty());
        CHECK(row.contains("problem") == !code.empty());
        CHECK(row.value("title", "") != "");
        if (code.empty()) continue;
        CHECK(row["problem"]["code"] == code);
        CHECK(row["problem"]["message"].get<std::string>() != "");
        const std::string self = row["links"]["self"];
        CHECK(get(server.port(), self).status == 200);
        CHECK(get(server.port(), self).json()["problem"]["code"] == code);
        if (code != "asset.name") CHECK(get(server.port(), self + "/image").status == 422);
    }
    CHECK(get(server.port(), "/v1/scenes/outside").status == 404);
    CHECK(get(server.port(), "/v1/scenes/outside-folder/passwd").status == 404);
    CHECK(get(server.port(), "/readyz").status == 200);
}

TEST_CASE("a scene that ends its worker is one bad row of the list") {
    const TemporaryFolder folder("folder-crash");
    for (const char* name : {"crash", "late", "broken", "full", "good"})
        folder.write(std::string(name) + ".xml", "<world/>");
    FakeServer server(serving(folder.path()));
    server.backend.onInspect = [](const render::Job& job) -> render::SceneReport {
        if (job.name == "crash.xml") throw worker::Busy(worker::message<"worker.crashed">(), 1);
        if (job.name == "late.xml") throw worker::Busy(worker::message<"busy.deadline">(), 1);
        if (job.name == "broken.xml") throw std::runtime_error("a secret of the server's");
        if (job.name == "full.xml") throw test::errorOf("limit.memory", "It is too large.");
        return {};
    };
    const auto rows = rowsOf(server.port());
    REQUIRE(rows.size() == 5);
    CHECK(rows.at("crash")["problem"]["code"] == "worker.crashed");
    CHECK(rows.at("late")["problem"]["code"] == "busy.deadline");
    CHECK(rows.at("broken")["problem"]["code"] == "internal");
    CHECK(rows.at("full")["problem"]["code"] == "limit.memory");
    CHECK(rows.at("good")["valid"] == true);
    CHECK(get(server.port(), "/v1/scenes").body.find("secret") == std::string::npos);
    // It is not tried with every list.
    const int tried = server.backend.inspections;
    CHECK(get(server.port(), "/v1/scenes?q=good").json()["total"] == 1);
    CHECK(server.backend.inspections == tried);

    // Where nothing can be read, no scene is to blame.
    folder.write("good.xml", "<world><group/></world>");
    server.backend.onInspect = [](const render::Job&) -> render::SceneReport {
        throw worker::Busy(worker::message<"busy.queue">(), 1);
    };
    CHECK(get(server.port(), "/v1/scenes").code() == "busy.queue");
}

TEST_CASE("a server that is short of memory or files is busy, and not at fault") {
    FakeServer server;
    server.backend.onRender = [](const render::Job&) -> render::Picture { throw std::bad_alloc(); };
    const Answer memory = post(server.port(), "/v1/render", "<world/>");
    CHECK(memory.status == 503);
    CHECK(memory.code() == "busy.resources");
    CHECK(memory.header("retry-after") != "");
    server.backend.onRender = [](const render::Job&) -> render::Picture {
        throw std::system_error(EMFILE, std::generic_category());
    };
    CHECK(post(server.port(), "/v1/render", "<world/>").code() == "busy.resources");
}

TEST_CASE("a folder that goes away is busy until it is back") {
    const TemporaryFolder folder("folder-away");
    const std::string served = folder.path() + "/scenes", away = folder.path() + "/away";
    folder.write("scenes/box.xml", "<world>1</world>");
    FakeServer server(serving(served));
    CHECK(get(server.port(), "/v1/scenes/box/source").body == "<world>1</world>");
    CHECK(get(server.port(), "/readyz").status == 200);
    fs::rename(served, away);
    for (const char* target :
         {"/readyz", "/v1/scenes", "/v1/scenes/box", "/v1/scenes/box/source", "/v1/scenes/none"}) {
        INFO(target);
        const Answer answer = get(server.port(), target);
        CHECK(answer.status == 503);
        CHECK(answer.code() == "busy.scenes");
        CHECK(answer.header("retry-after") != "");
    }
    CHECK(post(server.port(), "/v1/render", "<world/>").status == 200);
    fs::rename(away, served);
    CHECK(get(server.port(), "/readyz").status == 200);
    CHECK(get(server.port(), "/v1/scenes/box/source").body == "<world>1</world>");

    fs::rename(served, away);
    folder.write("scenes", "a file");
    CHECK(get(server.port(), "/v1/scenes").code() == "busy.scenes");
    fs::remove(served);
    folder.write("scenes/other.xml", "<world>2</world>");
    CHECK(get(server.port(), "/v1/scenes/box").status == 404);
    CHECK(get(server.port(), "/v1/scenes/other/source").body == "<world>2</world>");
}

TEST_CASE("a folder behind a link is the one that the link leads to now") {
    const TemporaryFolder folder("folder-link");
    folder.write("one/box.xml", "<world>1</world>");
    folder.write("two/box.xml", "<world>2</world>");
    const std::string link = folder.path() + "/current";
    const auto lead = [&](const char* target) {
        fs::create_directory_symlink(target, link + ".new");
        fs::rename(link + ".new", link);
    };
    lead("one");
    FakeServer server(serving(link));
    const auto source = [&] { return get(server.port(), "/v1/scenes/box/source").body; };
    CHECK(source() == "<world>1</world>");
    lead("two");
    CHECK(source() == "<world>2</world>");
    // The same folder elsewhere.
    fs::rename(folder.path() + "/two", folder.path() + "/three");
    lead("three");
    CHECK(source() == "<world>2</world>");
}

TEST_CASE("workers read the folder that is there now") {
    const TemporaryFolder folder("folder-workers");
    const std::string served = folder.path() + "/scenes";
    const auto fill = [&](const std::string& color) {
        folder.write("scenes/box/scene.xml",
                     model("triangle.obj", "<color><diffuse " + color + "/></color>"));
        folder.write("scenes/box/triangle.obj", "v -2 -2 0\nv 2 -2 0\nv 0 2 0\nf 1 2 3\n");
    };
    fill("R=\"255\" G=\"0\" B=\"0\"");
    worker::PoolOptions options;
    options.workers = 2;
    options.queue = {64, std::chrono::milliseconds(60'000), std::chrono::milliseconds(60'000)};
    options.worker.program = farol::test::kProgram;
    options.worker.scenesDir = served;
    worker::WorkerPool pool(options, [](const std::string&, const std::string&) {});
    TestServer server(pool, serving(served));
    const auto imageStatus = [&](const std::string& width) {
        const Answer answer =
            get(server.port(), "/v1/scenes/box/image?shading=solid&width=" + width);
        INFO(answer.body.substr(0, 300));
        CHECK(answer.status == 200);
        return answer.body;
    };
    const std::string before = imageStatus("50");
    for (int round = 0; round < 2; ++round) {
        fs::rename(served, folder.path() + "/old-" + std::to_string(round));
        fill("R=\"0\" G=\"255\" B=\"0\"");
        CHECK(imageStatus("50") != before);
        CHECK(imageStatus("51") != before);  // of either worker
        CHECK(get(server.port(), "/readyz").status == 200);
    }
    CHECK(pool.state().restarts.at("folder") >= 2);
    server.stop();
    pool.stop();
}
