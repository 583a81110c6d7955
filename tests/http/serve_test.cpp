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
    for (const int number : {SIGTERM, SIGINT}) {
        Daemon daemon({"--port", "0", "--scenes", std::string(FAROL_SOURCE_DIR) + "/scenes"});
        const int port = portIn(daemon.firstLine());
        CHECK(get(port, "/livez").status == 200);
        CHECK(get(port, "/readyz").status == 200);
        CHECK(get(port, "/version").json()["name"] == "farol");
        CHECK(get(port, "/v1/scenes").json()["total"].get<int>() > 0);
        CHECK(get(port, "/").body.find("<html") != std::string::npos);
        daemon.signal(number);
        CHECK(daemon.exitCode() == 0);
    }
}

TEST_CASE("a render in flight is answered when the program is told to end") {
    Daemon daemon({"--port", "0"});
    const int port = portIn(daemon.firstLine());
    REQUIRE(get(port, "/readyz").status == 200);
    const std::string scene =
        "<world><camera><position x=\"3\" y=\"2\" z=\"5\"/><lookAt x=\"0\" y=\"0\" z=\"0\"/>"
        "<up x=\"0\" y=\"1\" z=\"0\"/><projection fov=\"60\" near=\"1\" far=\"100\"/></camera>"
        "<group><models><model file=\"torus_2_0.5_300_300.3d\"/></models></group></world>";
    RawClient client(port);
    client.send(
        "POST /v1/render?width=2000&height=2000&aa=4 HTTP/1.1\r\nHost: x\r\n"
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

TEST_CASE("a client that asks too often is told when to come back") {
    Daemon daemon({"--port", "0", "--workers", "1", "--rate", "1", "--burst", "3"});
    const int port = portIn(daemon.firstLine());
    for (int i = 0; i < 3; ++i) CHECK(get(port, "/v1/primitives").status == 200);
    const Answer refused = get(port, "/v1/primitives");
    CHECK(refused.status == 429);
    CHECK(refused.code() == "limit.rate");
    CHECK(refused.header("retry-after") == "1");
    CHECK(get(port, "/livez").status == 200);  // whoever watches the service is not a client of it
}

TEST_CASE("serve that cannot listen says so and fails") {
    Daemon first({"--port", "0"});
    const int port = portIn(first.firstLine());
    Daemon second({"--port", std::to_string(port)});
    CHECK(second.firstLine().empty());
    CHECK(second.exitCode() != 0);
    Daemon nowhere({"--port", "0", "--scenes", "/there/is/no/such/folder"});
    CHECK(nowhere.firstLine().empty());
    CHECK(nowhere.exitCode() != 0);
}
