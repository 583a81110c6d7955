// The program itself: `farol serve` from its first line to its end by a signal.
#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "daemon.h"
#include "fixture.h"
#include "tests/support/paths.h"

using namespace farol::test;

namespace {

/// The processes that this one started, by /proc.
std::vector<pid_t> childrenOf(pid_t parent) {
    std::vector<pid_t> children;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
        std::ifstream in(entry.path() / "stat");
        std::string line;
        if (!std::getline(in, line)) continue;
        std::istringstream rest(line.substr(line.rfind(')') + 1));  // the name may hold anything
        char state = 0;
        pid_t of = 0;
        if (rest >> state >> of && of == parent && state != 'Z')
            children.push_back(std::stoi(entry.path().filename().string()));
    }
    return children;
}

/// True once none of them is there any more; false if one still is after ten seconds.
bool allGone(const std::vector<pid_t>& pids) {
    for (int i = 0; i < 1000; ++i) {
        std::size_t gone = 0;
        for (const pid_t pid : pids) {
            std::ifstream in("/proc/" + std::to_string(pid) + "/stat");
            std::string line;
            // A zombie waits for whoever inherits it.
            const bool dead =
                !std::getline(in, line) || line.compare(line.rfind(')') + 2, 1, "Z") == 0;
            if (dead) ++gone;
        }
        if (gone == pids.size()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
}

}  // namespace

TEST_CASE("workers end with the program, however it ends") {
    for (const int number : {SIGTERM, SIGKILL}) {
        Daemon daemon({"--port", "0", "--workers", "2", "--spares", "0"});
        const int port = portIn(daemon.firstLine());
        REQUIRE(get(port, "/readyz").status == 200);
        const std::vector<pid_t> workers = childrenOf(daemon.pid());
        CHECK(workers.size() == 2);
        daemon.signal(number);
        CHECK(daemon.exitCode() == (number == SIGKILL ? 128 + SIGKILL : 0));
        CHECK(allGone(workers));
    }
}

TEST_CASE("the program tells what its workers are kept in, and counts") {
    Daemon daemon({"--port", "0", "--workers", "1", "--spares", "0"});
    const int port = portIn(daemon.firstLine());
    const auto sandbox = get(port, "/version").json()["sandbox"];
    for (const char* layer : {"noNewPrivileges", "limits", "landlock", "seccomp", "deathSignal"})
        CHECK(sandbox.contains(layer));
    const std::vector<pid_t> workers = childrenOf(daemon.pid());
    for (const pid_t worker : workers) kill(worker, SIGKILL);
    REQUIRE(allGone(workers));
    // Until the death is noticed and the worker replaced, 503 is the honest answer.
    for (int i = 0; i < 1000 && get(port, "/readyz").status != 200; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    CHECK(get(port, "/readyz").status == 200);
    const std::string metrics = get(port, "/metrics").body;
    INFO(metrics);
    CHECK(metrics.find("farol_workers 1\n") != std::string::npos);
    // Idle, or killed if the probe above was handed to it before its death was noticed.
    const bool idle =
        metrics.find("farol_worker_restarts_total{reason=\"idle\"} 1\n") != std::string::npos;
    const bool killed =
        metrics.find("farol_worker_restarts_total{reason=\"killed\"} 1\n") != std::string::npos;
    CHECK(idle != killed);
    CHECK(metrics.find("farol_http_requests_total{route=\"/version\",code=\"200\"} 1\n") !=
          std::string::npos);
}

TEST_CASE("serve says where it listens, draws, and ends with 0 on a signal") {
    for (const int number : {SIGTERM, SIGINT, SIGHUP}) {
        Daemon daemon(
            {"--port", "0", "--scenes", std::string(farol::test::kSourceDir) + "/scenes"});
        const int port = portIn(daemon.firstLine());
        CHECK(get(port, "/livez").status == 200);
        CHECK(get(port, "/readyz").status == 200);
        const nlohmann::json version = get(port, "/version").json();
        CHECK(version["name"] == "farol");
        nlohmann::json formats = {"apng", "animated-webp", "gif"};
        if (std::filesystem::exists(
                std::filesystem::path(kProgram).replace_filename("libfarol_video.so")))
            formats.insert(formats.end(), {"mp4", "webm"});
        CHECK(version["animations"] == formats);
        CHECK(get(port, "/v1/scenes").json()["total"].get<int>() > 0);
        CHECK(get(port, "/").body.find("<html") != std::string::npos);
        daemon.signal(number);
        CHECK(daemon.exitCode() == 0);
    }
}

TEST_CASE("a render in flight is answered when the program is asked to end") {
    Daemon daemon({"--port", "0"});
    const int port = portIn(daemon.firstLine());
    REQUIRE(get(port, "/readyz").status == 200);
    const std::string scene =
        "<world><camera><position x=\"3\" y=\"2\" z=\"5\"/><lookAt x=\"0\" y=\"0\" z=\"0\"/>"
        "<up x=\"0\" y=\"1\" z=\"0\"/><projection fov=\"60\" near=\"1\" far=\"100\"/></camera>"
        "<group><models><model file=\"torus_2_0.5_300_300.3d\"/></models></group></world>";
    RawClient client(port);
    client.send(
        "POST /v1/render?width=2000&height=2000&aa=4 HTTP/1.1\r\nHost: localhost\r\n"
        "Content-Type: text/xml\r\nExpect: 100-continue\r\nContent-Length: " +
        std::to_string(scene.size()) + "\r\n\r\n");
    REQUIRE(client.read().status == 100);  // the request is with its handler now
    client.send(scene);
    daemon.signal(SIGTERM);
    const Answer answer = client.read();
    CHECK(answer.status == 200);
    CHECK(answer.closed);
    CHECK(daemon.exitCode() == 0);
}

TEST_CASE("a flag wins over the environment, the environment over the file") {
    const TemporaryFolder folder("settings");
    folder.write("farol.toml",
                 "port = 1        # taken by the flag\n"
                 "max-body = 100  # by the environment\n"
                 "workers = 1\ncors = \"https://example.org\"\n");
    setenv("FAROL_CONFIG", (folder.path() + "/farol.toml").c_str(), 1);
    setenv("FAROL_MAX_BODY", "50", 1);
    Daemon daemon({"--port", "0"});
    unsetenv("FAROL_CONFIG");
    unsetenv("FAROL_MAX_BODY");
    const int port = portIn(daemon.firstLine());
    const Answer big = post(port, "/v1/validate", std::string(51, 'x'), "text/xml");
    CHECK(big.status == 413);
    const Answer small = post(port, "/v1/validate", std::string(50, 'x'), "text/xml");
    CHECK(small.status == 400);
    CHECK(small.header("access-control-allow-origin") == "https://example.org");
    CHECK(get(port, "/readyz").json()["workers"] == 1);
}

TEST_CASE("a client that asks too often learns when to come back") {
    Daemon daemon({"--port", "0", "--workers", "1", "--rate", "1", "--burst", "3"});
    const int port = portIn(daemon.firstLine());
    for (int i = 0; i < 3; ++i) CHECK(get(port, "/v1/primitives").status == 200);
    const Answer refused = get(port, "/v1/primitives");
    CHECK(refused.status == 429);
    CHECK(refused.code() == "limit.rate");
    CHECK(refused.header("retry-after") == "1");
    CHECK(get(port, "/livez").status == 200);  // health checks do not count
}

TEST_CASE("serve that cannot listen says so and fails") {
    Daemon first({"--port", "0"});
    const int port = portIn(first.firstLine());
    Daemon second({"--port", std::to_string(port)});
    CHECK(second.firstLine().empty());
    CHECK(second.exitCode() != 0);
    Daemon noHost({"--port", "0", "--allowed-hosts", "http://farol"});
    CHECK(noHost.exitCode() == 2);
    Daemon fewDescriptors({"--port", "0"}, {.descriptors = 64});
    CHECK(fewDescriptors.exitCode() == 2);
    Daemon manyConnections({"--port", "0", "--max-connections", "1000"}, {.descriptors = 512});
    CHECK(manyConnections.exitCode() == 2);
    Daemon nowhere({"--port", "0", "--scenes", "/there/is/no/such/folder"});
    CHECK(nowhere.firstLine().empty());
    CHECK(nowhere.exitCode() != 0);
}

TEST_CASE("a log that nobody reads neither stops the service nor its end") {
    int ends[2];
    REQUIRE(pipe2(ends, O_CLOEXEC) == 0);
    Daemon daemon({"--port", "0", "--workers", "1", "--spares", "0"}, {.stderrFd = ends[1]});
    const int port = portIn(daemon.firstLine());
    // Each line has the path: more than pipe and queue hold.
    for (int i = 0; i < 3000; ++i) REQUIRE(get(port, "/" + std::string(1000, 'a')).status == 404);
    const std::string name = "\nfarol_log_lines_dropped_total ";
    const std::string metrics = get(port, "/metrics").body;
    const std::size_t at = metrics.find(name);
    REQUIRE(at != std::string::npos);
    CHECK(std::stoi(metrics.substr(at + name.size())) > 0);
    daemon.signal(SIGTERM);
    CHECK(daemon.exitCode() == 0);
    close(ends[0]);
    close(ends[1]);
}

TEST_CASE("a log whose reader has gone does not end the service") {
    int ends[2];
    REQUIRE(pipe2(ends, O_CLOEXEC) == 0);
    Daemon daemon({"--port", "0", "--workers", "1", "--spares", "0"}, {.stderrFd = ends[1]});
    close(ends[1]);
    const int port = portIn(daemon.firstLine());
    close(ends[0]);
    for (int i = 0; i < 10; ++i) CHECK(get(port, "/livez").status == 200);
    daemon.signal(SIGTERM);
    CHECK(daemon.exitCode() == 0);
}

TEST_CASE("standard descriptors that are closed are nobody else's") {
    const TemporaryFolder folder("closed-descriptors");
    const std::string box =
        "<world><group><models><model file=\"box_1_1.3d\"/></models></group></world>";
    for (const char* const names : {"2", "02", "0"}) {
        const std::string closed = names;
        INFO("closed: " << closed);
        Daemon daemon({"--port", "0", "--workers", "1", "--spares", "0", "--data", folder.path()},
                      {.closed = closed});
        const int port = portIn(daemon.firstLine());
        for (const char fd : closed) {
            const std::string link = "/proc/" + std::to_string(daemon.pid()) + "/fd/" + fd;
            CHECK(std::filesystem::read_symlink(link) == "/dev/null");
        }
        for (int i = 0; i < 3; ++i) CHECK(post(port, "/v1/render", box).status == 200);
        daemon.signal(SIGTERM);
        CHECK(daemon.exitCode() == 0);
    }
}

TEST_CASE("a service that drains is unready and serves until a second signal") {
    Daemon daemon({"--port", "0", "--workers", "1", "--spares", "0", "--drain", "3600"});
    const int port = portIn(daemon.firstLine());
    REQUIRE(get(port, "/readyz").status == 200);
    daemon.signal(SIGTERM);
    Answer unready;
    for (int i = 0; i < 1000 && unready.status != 503; ++i) {
        unready = get(port, "/readyz");
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    CHECK(unready.code() == "busy.draining");
    CHECK(get(port, "/v1/primitives").status == 200);
    CHECK(get(port, "/livez").status == 200);
    daemon.signal(SIGTERM);
    CHECK(daemon.exitCode() == 0);
}

TEST_CASE("the service answers for loopback names, and for others that are configured") {
    const auto statusOf = [](int port, const std::string& host) {
        RawClient client(port);
        client.send("GET /version HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
        return client.read().status;
    };
    const std::vector<std::string> quick = {"--port", "0", "--workers", "1", "--spares", "0"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.end(), quick.begin(), quick.end());
        return more;
    };
    {
        Daemon daemon(quick);
        const int port = portIn(daemon.firstLine());
        for (const char* host : {"localhost", "127.0.0.1:1", "[::1]"})
            CHECK(statusOf(port, host) == 200);
        CHECK(statusOf(port, "farol.example") == 421);
    }
    {
        Daemon daemon(with({"--allowed-hosts", "farol.example, localhost:80"}));
        const int port = portIn(daemon.firstLine());
        CHECK(statusOf(port, "farol.example") == 200);
        CHECK(statusOf(port, "localhost:80") == 200);
        CHECK(statusOf(port, "127.0.0.1") == 421);
    }
    int ends[2];
    REQUIRE(pipe2(ends, O_CLOEXEC) == 0);
    {
        Daemon daemon(with({"--host", "0.0.0.0"}), {.stderrFd = ends[1]});
        const std::string line = daemon.firstLine();
        const int port = std::stoi(line.substr(line.rfind(':') + 1));
        CHECK(statusOf(port, "farol.example") == 200);
        daemon.signal(SIGTERM);
        CHECK(daemon.exitCode() == 0);
    }
    close(ends[1]);
    std::string log;
    for (char c = 0; read(ends[0], &c, 1) == 1;) log += c;
    close(ends[0]);
    CHECK_THAT(log, Catch::Contains("--allowed-hosts"));
}

TEST_CASE("a service with few descriptors takes as many connections as it has") {
    Daemon daemon({"--port", "0", "--workers", "1", "--spares", "0", "--threads", "4"},
                  {.descriptors = 100});
    const int port = portIn(daemon.firstLine());
    std::vector<std::unique_ptr<RawClient>> idle;
    for (int i = 0; i < 150; ++i) idle.push_back(std::make_unique<RawClient>(port));
    for (int i = 0; i < 10; ++i) CHECK(get(port, "/livez").status == 200);
    const std::string metrics = get(port, "/metrics").body;
    CHECK(metrics.find("closed_total{reason=\"connections_full\"} 0\n") != std::string::npos);
    CHECK(get(port, "/v1/scenes").status == 200);
}

TEST_CASE("a service out of descriptors goes on with those it has") {
    Daemon daemon({"--port", "0", "--workers", "1", "--spares", "0", "--keep-alive", "3600"});
    const int port = portIn(daemon.firstLine());
    std::vector<std::unique_ptr<RawClient>> idle;
    for (int i = 0; i < 10; ++i) {
        idle.push_back(std::make_unique<RawClient>(port));
        idle.back()->send("GET /livez HTTP/1.1\r\n\r\n");
        REQUIRE(idle.back()->read().status == 200);
    }
    rlim_t highest = 0;
    const std::string fds = "/proc/" + std::to_string(daemon.pid()) + "/fd";
    for (const auto& entry : std::filesystem::directory_iterator(fds))
        highest = std::max<rlim_t>(highest, std::stoul(entry.path().filename().string()));
    const rlimit limit{highest + 1, highest + 1};
    REQUIRE(prlimit(daemon.pid(), RLIMIT_NOFILE, &limit, nullptr) == 0);
    // None goes away by itself: the idle ones make room.
    std::vector<std::unique_ptr<RawClient>> later;
    for (int i = 0; i < 20; ++i) {
        later.push_back(std::make_unique<RawClient>(port));
        later.back()->send("GET /livez HTTP/1.1\r\n\r\n");
        CHECK(later.back()->read().status == 200);
    }
    daemon.signal(SIGTERM);
    CHECK(daemon.exitCode() == 0);
}
