// Worker processes: what happens to a request, and to the others, when one of them goes wrong.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <thread>

#include "fixture.h"
#include "server/worker/pool.h"
#include "server/worker/quarantine.h"

using namespace farol;
using namespace farol::server;
using namespace farol::server::worker;
using namespace std::chrono_literals;

namespace {

Logger& quiet() {
    static Logger logger([](const std::string&) {});
    return logger;
}

PoolOptions options(int workers = 1) {
    PoolOptions options;
    options.workers = workers;
    options.queue = {16, 60s, 60s};
    options.worker.program = FAROL_BINARY;
    options.replacement = 60s;
    options.spares = 0;  // so that a test knows which processes there are
    return options;
}

render::Job boxJob(const std::string& color = "255") {
    render::Job job;
    job.xml =
        "<world><window width=\"32\" height=\"32\"/><camera><position x=\"3\" y=\"2\" z=\"5\"/>"
        "<lookAt x=\"0\" y=\"0\" z=\"0\"/><up x=\"0\" y=\"1\" z=\"0\"/>"
        "<projection fov=\"60\" near=\"1\" far=\"100\"/></camera><group><models>"
        "<model file=\"box_2_1.3d\"><color><diffuse R=\"" +
        color + "\" G=\"0\" B=\"0\"/></color></model></models></group></world>";
    job.assets = std::make_shared<scene::BundleAssets>();
    return job;
}

/// "done", or the code of what was thrown.
std::string codeOf(const std::function<void()>& work) {
    try {
        work();
        return "done";
    } catch (const Busy& busy) {
        CHECK(busy.retryAfterS() >= 1);
        return busy.code();
    } catch (const Error& error) {
        return error.code();
    }
}

/// A render that cannot end, since its worker is stopped; then `signal` to that worker.
std::string codeWhenHit(WorkerPool& pool, const render::Job& job, int signal) {
    const pid_t pid = pool.pids().at(0);
    kill(pid, SIGSTOP);
    std::string code;
    std::thread client([&] { code = codeOf([&] { pool.render(job, "", {}); }); });
    while (pool.state().busy == 0) std::this_thread::sleep_for(1ms);
    kill(pid, signal);
    if (signal != SIGKILL) kill(pid, SIGCONT);
    client.join();
    return code;
}

long restarts(const WorkerPool& pool, const std::string& reason) {
    const auto all = pool.state().restarts;
    const auto found = all.find(reason);
    return found == all.end() ? 0 : found->second;
}

bool exists(pid_t pid) { return kill(pid, 0) == 0; }

}  // namespace

TEST_CASE("a request whose worker is killed from outside is drawn by the next one") {
    WorkerPool pool(options(), quiet());
    CHECK(codeWhenHit(pool, boxJob(), SIGKILL) == "done");
    CHECK(restarts(pool, "killed") == 1);
    CHECK(pool.state().retried == 1);
    CHECK(pool.render(boxJob(), "", {}).result.bytes.size() > 50);
    // One that dies while nobody needs it costs nothing.
    const pid_t idle = pool.pids().at(0);
    kill(idle, SIGKILL);
    while (restarts(pool, "idle") == 0) std::this_thread::sleep_for(1ms);
    CHECK(codeOf([&] { pool.check(); }) == "done");
    CHECK(pool.pids().at(0) != idle);
}

TEST_CASE("a request whose workers are killed again and again is given up, and blamed for none") {
    WorkerPool pool(options(), quiet());
    render::Job job = boxJob();
    job.options.width = job.options.height = 4000;
    job.options.samples = 16;  // takes seconds: the killer comes in time
    for (int round = 1; round <= 2; ++round) {
        std::atomic<bool> isOver{false};
        std::thread killer([&] {
            while (!isOver)
                if (pool.state().busy > 0)
                    for (const pid_t pid : pool.pids()) kill(pid, SIGKILL);
        });
        CHECK(codeOf([&] { pool.render(job, "", {}); }) == "worker.killed");
        isOver = true;
        killer.join();
        CHECK(pool.state().retried == 2 * round);
        CHECK(restarts(pool, "killed") + restarts(pool, "idle") >= 3 * round);
    }
    CHECK(codeOf([&] { pool.render(boxJob(), "", {}); }) == "done");  // no quarantine
}

TEST_CASE("a worker that hangs is ended at the deadline") {
    PoolOptions impatient = options();
    impatient.queue.deadline = 1500ms;
    WorkerPool pool(impatient, quiet());
    const pid_t before = pool.pids().at(0);
    kill(before, SIGSTOP);
    CHECK(codeOf([&] { pool.render(boxJob(), "", {}); }) == "busy.deadline");
    CHECK(restarts(pool, "deadline") == 1);
    CHECK_FALSE(exists(before));
    CHECK(codeOf([&] { pool.check(); }) == "done");
}

TEST_CASE("a scene that ends two workers is kept out, others are not") {
    WorkerPool pool(options(), quiet());
    CHECK(codeWhenHit(pool, boxJob("10"), SIGSEGV) == "worker.crashed");
    CHECK(codeOf([&] { pool.check(); }) == "done");  // the next worker is there
    CHECK(codeWhenHit(pool, boxJob("10"), SIGSEGV) == "worker.crashed");
    CHECK(restarts(pool, "crash") == 2);
    CHECK(codeOf([&] { pool.render(boxJob("10"), "", {}); }) == "worker.quarantine");
    CHECK(codeOf([&] { pool.inspect(boxJob("10")); }) == "worker.quarantine");
    CHECK(codeOf([&] { pool.render(boxJob("20"), "", {}); }) == "done");
    CHECK(restarts(pool, "crash") == 2);
}

TEST_CASE("quarantine ends by time, a success wipes the slate, and its memory is bounded") {
    Quarantine quarantine(60s);
    const auto start = Quarantine::Clock::now();
    quarantine.strike("a", start);
    CHECK(quarantine.left("a", start).count() == 0);
    quarantine.strike("a", start);
    CHECK(quarantine.left("a", start).count() == 60);
    CHECK(quarantine.left("b", start).count() == 0);
    CHECK(quarantine.left("a", start + 60s).count() == 0);
    CHECK(quarantine.left("a", start).count() == 0);  // forgotten
    quarantine.strike("c", start);
    quarantine.success("c");
    quarantine.strike("c", start);
    CHECK(quarantine.left("c", start).count() == 0);
    quarantine.strike("d", start);
    quarantine.strike("d", start + 61s);  // the first is too long ago
    CHECK(quarantine.left("d", start + 61s).count() == 0);
    for (std::size_t i = 0; i < Quarantine::kMaxScenes; ++i)
        quarantine.strike("x" + std::to_string(i), start + 100s);
    quarantine.strike("c", start + 100s);  // its strike above was the oldest and had to go
    CHECK(quarantine.left("c", start + 100s).count() == 0);
}

TEST_CASE("workers are replaced after their share of jobs, and no job notices") {
    PoolOptions often = options();
    often.recycleAfter = 3;
    WorkerPool pool(often, quiet());
    const std::string first = pool.render(boxJob(), "", {}).result.bytes;
    for (int i = 0; i < 8; ++i) CHECK(pool.render(boxJob(), "", {}).result.bytes == first);
    CHECK(restarts(pool, "recycled") >= 2);
}

TEST_CASE("pictures asked for while they are being drawn are drawn once") {
    WorkerPool pool(options(), quiet());
    const pid_t pid = pool.pids().at(0);
    kill(pid, SIGSTOP);
    std::vector<std::thread> clients;
    std::vector<std::string> pictures(4);
    for (std::string& picture : pictures)
        clients.emplace_back([&] { picture = pool.render(boxJob(), "\"tag\"", {}).result.bytes; });
    while (pool.state().coalesced < 3) std::this_thread::sleep_for(1ms);
    kill(pid, SIGCONT);
    for (std::thread& client : clients) client.join();
    CHECK_FALSE(pictures[0].empty());
    for (const std::string& picture : pictures) CHECK(picture == pictures[0]);
    pool.render(boxJob(), "\"tag\"", {});  // over: drawn anew
    CHECK(pool.state().coalesced == 3);
}

TEST_CASE("a scene that wants too much memory fails alone") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    WARN("skipped: a sanitizer's build has no memory cap");
#else
    PoolOptions tight = options();
    tight.worker.memoryBytes = std::size_t{512} << 20U;
    WorkerPool pool(tight, quiet());
    render::Job hog = boxJob();
    hog.options.width = hog.options.height = 4096;
    hog.options.samples = 4;  // 64 bytes a pixel and more
    const std::string code = codeOf([&] { pool.render(hog, "", {}); });
    INFO(code);
    CHECK((code == "limit.memory" || code == "worker.crashed"));
    CHECK(codeOf([&] { pool.render(boxJob(), "", {}); }) == "done");
#endif
}

TEST_CASE("a spare takes a lost worker's place before it could have been started") {
    PoolOptions spared = options();
    spared.spares = 1;
    WorkerPool pool(spared, quiet());
    pool.check();
    const pid_t before = pool.pids().at(0);
    kill(before, SIGKILL);
    for (int i = 0; i < 100 && codeOf([&] { pool.render(boxJob(), "", {}); }) != "done"; ++i)
        std::this_thread::sleep_for(10ms);
    CHECK(pool.pids().at(0) != before);
    CHECK(codeOf([&] { pool.render(boxJob(), "", {}); }) == "done");
}

TEST_CASE("what a worker prints becomes a line of the log") {
    std::mutex mutex;
    std::vector<std::string> lines;
    Logger logger([&](const std::string& line) {
        const std::lock_guard lock(mutex);
        lines.push_back(line);
    });
    {
        server::worker::Said said(
            [&](const std::string& line) { logger.event("worker-said", line); });
        const std::string text = "libpng error: \"bad\" IDAT\nunfinished";
        REQUIRE(write(said.descriptor(), text.data(), text.size()) ==
                static_cast<ssize_t>(text.size()));
        const std::string flood(1 << 20, 'x');  // more than the pipe takes: nobody waits
        CHECK(write(said.descriptor(), flood.data(), flood.size()) <
              static_cast<ssize_t>(flood.size()));
    }
    const std::lock_guard lock(mutex);
    REQUIRE(lines.size() == 2);
    CHECK(lines[0].find("libpng error: \\\"bad\\\" IDAT") != std::string::npos);
    CHECK(lines[1].size() < 1'000);
}

TEST_CASE("workers end with the pool") {
    std::vector<pid_t> pids;
    {
        WorkerPool pool(options(2), quiet());
        pool.check();
        while ((pids = pool.pids()).size() < 2) std::this_thread::sleep_for(1ms);
        for (const pid_t pid : pids) CHECK(exists(pid));
    }
    for (const pid_t pid : pids) CHECK_FALSE(exists(pid));
}

TEST_CASE("a program that is no worker is said to be none") {
    PoolOptions wrong = options();
    wrong.worker.program = "/bin/false";
    std::atomic<int> said{0};
    Logger logger([&](const std::string& line) {
        if (line.find("worker-start") != std::string::npos) ++said;
    });
    wrong.queue.wait = 50ms;
    WorkerPool pool(wrong, logger);
    CHECK(said >= 1);
    CHECK(codeOf([&] { pool.check(); }) == "busy.queue");
    CHECK(pool.state().workers == 0);
}

TEST_CASE("a worker can neither reach out nor write nor read what is not a scene") {
    const farol::test::TemporaryFolder folder("worker-sandbox");
    folder.write("scenes/a.xml", "<world/>");
    folder.write("secret", "of somebody");
    const std::string scenes = folder.path() + "/scenes", secret = folder.path() + "/secret";
    const std::string home = folder.path() + "/home";
    const std::string command = "env -u MESA_SHADER_CACHE_DIR -u XDG_CACHE_HOME HOME='" + home +
                                "' " + FAROL_BINARY + " worker --scenes '" + scenes +
                                "' --memory 2147483648 --self-test '" + secret + "'";
    FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    std::string text;
    for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) text += static_cast<char>(c);
    CHECK(pclose(pipe) == 0);
    const auto said = nlohmann::json::parse(text, nullptr, false);
    INFO(text);
    REQUIRE(said.is_object());
    CHECK(said["before"] == "done");
    CHECK(said["draws"] == true);
    CHECK(said["readsRarePictures"] == true);
    CHECK(said["reads"][scenes] == "done");
    const auto layers = said["layers"];
    const bool landlock = layers.value("landlock", "missing").rfind("abi", 0) == 0;
    const bool seccomp = layers.value("seccomp", "missing") == "on";
    if (!landlock) WARN("no Landlock here, so that reading is not held back: " << layers);
    if (!seccomp) WARN("no seccomp here: " << layers);
    for (const auto& [what, came] : said["tried"].items()) {
        const bool reads = what.rfind("read", 0) == 0;
        if (reads ? !landlock : !seccomp) continue;
        INFO(what);
        CHECK(came != "done");
    }
    CHECK(said["tried"].size() >= 20);
    // Mesa found its cache, without which every start compiles all shaders.
    CHECK(std::filesystem::exists(home + "/.cache/mesa_shader_cache/index"));
    std::ifstream secretFile(secret);
    std::string content;
    std::getline(secretFile, content);
    CHECK(content == "of somebody");
}
