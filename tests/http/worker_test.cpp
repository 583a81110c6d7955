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
#include "grade/rubric/rubric.h"
#include "image/format.h"
#include "tests/support/paths.h"
#include "tests/support/pool_process.h"
#include "tests/support/skip.h"
#include "worker/pool.h"
#include "worker/tasks/check.h"
#include "worker/tasks/compare.h"
#include "worker/tasks/grade.h"
#include "worker/tasks/inspect.h"
#include "worker/tasks/mesh.h"
#include "worker/tasks/notice.h"
#include "worker/tasks/render.h"

using namespace farol;
using namespace farol::server;
using namespace farol::worker;
using namespace std::chrono_literals;
using farol::test::childrenBut;
using farol::test::workerOf;

namespace {

EventLog quiet() {
    return [](const std::string&, const std::string&) {};
}

PoolOptions options(int workers = 1) {
    PoolOptions options;
    options.workers = workers;
    options.queue = {16, 60s, 60s};
    options.worker.program = farol::test::kProgram;
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
    } catch (const worker::Busy& busy) {
        CHECK(busy.retryAfterS() >= 1);
        return busy.code();
    } catch (const Error& error) {
        return error.code();
    }
}

/// A render that cannot end, since its worker is stopped; then `signal` to that worker.
std::string codeWhenHit(WorkerPool& pool, const render::Job& job, int signal) {
    const pid_t pid = workerOf(pool);
    kill(pid, SIGSTOP);
    std::string code;
    std::thread client([&] { code = codeOf([&] { pool.run<RenderTask>({job}); }); });
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
    CHECK(pool.run<RenderTask>({boxJob()}).result.bytes.size() > 50);
    // One that dies while nobody needs it costs nothing.
    const pid_t idle = workerOf(pool);
    kill(idle, SIGKILL);
    while (restarts(pool, "idle") == 0) std::this_thread::sleep_for(1ms);
    CHECK(codeOf([&] { pool.run<CheckTask>({}); }) == "done");
    CHECK(workerOf(pool) != idle);
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
                if (pool.state().busy > 0 && pool.state().workers > 0)
                    for (const pid_t pid : childrenBut()) kill(pid, SIGKILL);
        });
        CHECK(codeOf([&] { pool.run<RenderTask>({job}); }) == "worker.killed");
        isOver = true;
        killer.join();
        CHECK(pool.state().retried == 2 * round);
        CHECK(restarts(pool, "killed") + restarts(pool, "idle") >= 3 * round);
    }
    CHECK(codeOf([&] { pool.run<RenderTask>({boxJob()}); }) == "done");  // no quarantine
}

TEST_CASE("a worker that is stopped is ended at the deadline") {
    PoolOptions impatient = options();
    impatient.queue.deadline = 1500ms;
    WorkerPool pool(impatient, quiet());
    const pid_t before = workerOf(pool);
    kill(before, SIGSTOP);
    CHECK(codeOf([&] { pool.run<RenderTask>({boxJob()}); }) == "busy.deadline");
    CHECK(restarts(pool, "stalled") == 1);
    CHECK_FALSE(exists(before));
    CHECK(codeOf([&] { pool.run<CheckTask>({}); }) == "done");
}

TEST_CASE("workers are replaced after their share of jobs, and no job notices") {
    PoolOptions often = options();
    often.recycleAfter = 3;
    WorkerPool pool(often, quiet());
    const std::string first = pool.run<RenderTask>({boxJob()}).result.bytes;
    for (int i = 0; i < 8; ++i) CHECK(pool.run<RenderTask>({boxJob()}).result.bytes == first);
    CHECK(restarts(pool, "recycled") >= 2);
}

TEST_CASE("pictures asked for while they are being drawn are drawn once") {
    WorkerPool pool(options(), quiet());
    const pid_t pid = workerOf(pool);
    kill(pid, SIGSTOP);
    std::vector<std::thread> clients;
    std::vector<std::string> pictures(4);
    for (std::string& picture : pictures)
        clients.emplace_back([&] {
            picture = pool.run<RenderTask>({boxJob()}, {"\"tag\"", {}}).result.bytes;
        });
    while (pool.state().coalesced < 3) std::this_thread::sleep_for(1ms);
    kill(pid, SIGCONT);
    for (std::thread& client : clients) client.join();
    CHECK_FALSE(pictures[0].empty());
    for (const std::string& picture : pictures) CHECK(picture == pictures[0]);
    pool.run<RenderTask>({boxJob()}, {"\"tag\"", {}});  // over: drawn anew
    CHECK(pool.state().coalesced == 3);
}

TEST_CASE("a scene that wants too much memory fails alone") {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    test::skip("a build with sanitizers has no memory limit");
#else
    PoolOptions tight = options();
    tight.worker.memoryBytes = std::size_t{512} << 20U;
    WorkerPool pool(tight, quiet());
    render::Job hog = boxJob();
    hog.options.width = hog.options.height = 4096;
    hog.options.samples = 4;  // 64 bytes a pixel and more, where models are
    hog.options.fovDeg = 10;  // of the box alone
    const std::string code = codeOf([&] { pool.run<RenderTask>({hog}); });
    INFO(code);
    CHECK((code == "limit.memory" || code == "worker.crashed"));
    CHECK(codeOf([&] { pool.run<RenderTask>({boxJob()}); }) == "done");
#endif
}

TEST_CASE("a spare takes a lost worker's place before it could have been started") {
    PoolOptions spared = options();
    spared.spares = 1;
    WorkerPool pool(spared, quiet());
    pool.run<CheckTask>({});
    std::vector<pid_t> both;
    while ((both = childrenBut()).size() < 2) std::this_thread::sleep_for(1ms);
    // They are started one after the other, and the first is used.
    kill(*std::min_element(both.begin(), both.end()), SIGKILL);
    while (restarts(pool, "idle") == 0) std::this_thread::sleep_for(1ms);
    CHECK(codeOf([&] { pool.run<RenderTask>({boxJob()}); }) == "done");
    CHECK(codeOf([&] { pool.run<RenderTask>({boxJob()}); }) == "done");
    CHECK(restarts(pool, "idle") == 1);
}

TEST_CASE("what a worker prints becomes a line of the log") {
    std::mutex mutex;
    std::vector<std::string> lines;
    Logger logger([&](const std::string& line) {
        const std::lock_guard lock(mutex);
        lines.push_back(line);
    });
    {
        worker::WorkerOutput said(
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

TEST_CASE("a worker that prints without end costs the parent a bounded amount of reading") {
    std::size_t accepted = 0;
    const auto begin = std::chrono::steady_clock::now();
    std::chrono::duration<double> took{0};
    {
        worker::WorkerOutput said([](const std::string&) {});
        const std::string flood(1 << 16, 'x');
        while (accepted < (std::size_t{64} << 20U) && took < 2s) {
            const ssize_t written = write(said.descriptor(), flood.data(), flood.size());
            if (written > 0) accepted += static_cast<std::size_t>(written);
            took = std::chrono::steady_clock::now() - begin;
        }
    }
    // A mebibyte for each second begun, and what the pipe holds.
    CHECK(static_cast<double>(accepted) <= (took.count() + 2.0) * (1 << 20));
}

TEST_CASE("an upload's worker ends after its job when uploads are isolated") {
    PoolOptions isolating = options();
    isolating.isolatesUploads = true;
    WorkerPool pool(isolating, quiet());
    const auto waitFor = [&](const char* reason, long count) {
        while (restarts(pool, reason) < count || pool.state().workers == 0)
            std::this_thread::sleep_for(1ms);
    };
    // The worker and its spare are started one after the other, and the first is used.
    std::vector<pid_t> both;
    while ((both = childrenBut()).size() < 2) std::this_thread::sleep_for(1ms);
    const pid_t first = *std::min_element(both.begin(), both.end());
    // A scene of the served folder shares its worker with the next one.
    const farol::test::TemporaryFolder folder("isolated");
    render::Job served = boxJob();
    served.assets = std::make_shared<scene::FolderAssets>(folder.path());
    served.identity = "\"tag\"";
    CHECK(codeOf([&] { pool.run<RenderTask>({served}); }) == "done");
    CHECK(codeOf([&] { pool.run<MeshTask>({{"box", "1", "1"}, "3d"}); }) == "done");
    CHECK(codeOf([&] { pool.run<CheckTask>({}); }) == "done");
    CHECK(restarts(pool, "isolated") == 0);
    CHECK(exists(first));
    // An upload does not, nor a document that was sent for the files of a served scene.
    CHECK(codeOf([&] { pool.run<RenderTask>({boxJob()}); }) == "done");
    waitFor("isolated", 1);
    CHECK_FALSE(exists(first));
    served.identity = "0123456789abcdef";
    CHECK(codeOf([&] { pool.run<InspectTask>({served}); }) == "done");
    waitFor("isolated", 2);
    // One that is refused does neither.
    render::Job refused = boxJob();
    refused.xml = "<world";
    CHECK(codeOf([&] { pool.run<RenderTask>({refused}); }) != "done");
    waitFor("isolated", 3);
    CHECK(codeOf([&] { pool.run<NoticeTask>({"text", {}}); }) == "done");
    waitFor("isolated", 4);
    CHECK(codeOf([&] { pool.run<CheckTask>({}); }) == "done");
    CHECK(restarts(pool, "crash") + restarts(pool, "killed") == 0);
}

TEST_CASE("a worker that computes without a job is replaced") {
    const farol::test::TemporaryFolder folder("busy-worker");
    const std::string hello = pack(Hello{});
    const std::uint64_t size = hello.size();
    folder.write("hello", std::string(reinterpret_cast<const char*>(&size), sizeof size) + hello);
    folder.write("worker",
                 "#!/bin/sh\ncat '" + folder.path() + "/hello' >&3\nwhile :; do :; done\n");
    std::filesystem::permissions(folder.path() + "/worker", std::filesystem::perms::owner_all);
    PoolOptions spinning = options();
    spinning.worker.program = folder.path() + "/worker";
    WorkerPool pool(spinning, quiet());
    while (restarts(pool, "busy") == 0) std::this_thread::sleep_for(1ms);
    CHECK(restarts(pool, "crash") == 0);
}

TEST_CASE("comparing and grading are bounded in cost as drawing is") {
    PoolOptions cheap = options();
    cheap.worker.maxCost = 0.002;
    WorkerPool pool(cheap, quiet());
    const auto picture = [](int side, std::uint8_t level) {
        image::Image image{side, side, {}};
        image.pixels.assign(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 4,
                            level);
        return image::encodePng(image);
    };
    const auto codes = [&](int side) {
        CompareTask::Request compared;
        compared.first.picture = picture(side, 255);
        compared.second.picture = picture(side, 100);
        GradeTask::Request graded;
        graded.reference = compared.first;
        graded.submission = compared.second;
        graded.rubric = packRubric(grade::defaultRubric());
        return codeOf([&] { pool.run<CompareTask>(compared); }) + " " +
               codeOf([&] { pool.run<GradeTask>(graded); });
    };
    CHECK(codes(16) == "done done");
    CHECK(codes(128) == "limit.cost limit.cost");
    CHECK(codeOf([&] { pool.run<RenderTask>({boxJob()}); }) == "done");
    render::Job large = boxJob();
    large.options.width = large.options.height = 1024;
    CHECK(codeOf([&] { pool.run<RenderTask>({large}); }) == "limit.cost");
    CHECK(codeOf([&] { pool.run<CheckTask>({}); }) == "done");
    const auto jobs = pool.state().jobs;
    CHECK(jobs.at("compare").done == 1);
    CHECK(jobs.at("compare").refused == 1);
    CHECK(jobs.at("render").refused == 1);
    CHECK(jobs.at("check").failed == 0);
}

TEST_CASE("workers end with the pool") {
    std::vector<pid_t> pids;
    {
        WorkerPool pool(options(2), quiet());
        pool.run<CheckTask>({});
        while (pool.state().workers < 2) std::this_thread::sleep_for(1ms);
        pids = childrenBut();
        CHECK(pids.size() >= 2);
        for (const pid_t pid : pids) CHECK(exists(pid));
    }
    for (const pid_t pid : pids) CHECK_FALSE(exists(pid));
}

TEST_CASE("a program that is no worker is reported as such") {
    PoolOptions wrong = options();
    wrong.worker.program = "/bin/false";
    std::atomic<int> said{0};
    wrong.queue.wait = 50ms;
    WorkerPool pool(wrong, [&](const std::string& name, const std::string&) {
        if (name == "worker-start") ++said;
    });
    CHECK(said >= 1);
    CHECK(codeOf([&] { pool.run<CheckTask>({}); }) == "busy.queue");
    CHECK(pool.state().workers == 0);
}

namespace {

/// The result of `farol worker --self-test` on `probe`, its home folder being `home`.
nlohmann::json selfTest(const std::string& scenes, const std::string& probe,
                        const std::string& home, const std::string& more = "") {
    const std::string command = "env -u MESA_SHADER_CACHE_DIR -u XDG_CACHE_HOME HOME='" + home +
                                "' " + farol::test::kProgram + " worker --scenes '" + scenes +
                                "' --memory 2147483648 --self-test '" + probe + "' " + more;
    FILE* pipe = popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    std::string text;
    for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) text += static_cast<char>(c);
    CHECK(pclose(pipe) == 0);
    INFO(text);
    const auto result = nlohmann::json::parse(text, nullptr, false);
    REQUIRE(result.is_object());
    return result;
}

void checkForbiddenCalls(const nlohmann::json& result) {
    if (result["layers"].value("seccomp", "missing") != "on") return;
    CHECK(result["calls"].size() >= 59);
    for (const auto& [name, outcome] : result["calls"].items()) {
        INFO(name);
        CHECK(outcome == "EPERM");
    }
}

}  // namespace

TEST_CASE("a process of the command line is closed in but for Mesa's shader cache") {
    const farol::test::TemporaryFolder folder("command-sandbox");
    folder.write("scenes/a.xml", "<world/>");
    folder.write("secret", "of somebody");
    const std::string home = folder.path() + "/home";
    const auto result =
        selfTest(folder.path() + "/scenes", folder.path() + "/secret", home, "--command-line");
    INFO(result);
    CHECK(result["before"] == "done");
    CHECK(result["draws"] == true);
    CHECK(result["readsOpenExr"] == 128);
    CHECK(result["reads"][folder.path() + "/scenes"] == "done");
    checkForbiddenCalls(result);
    const auto& layers = result["layers"];
    if (layers["landlock"].get<std::string>().rfind("abi", 0) == 0 && layers["seccomp"] == "on")
        for (const auto& [name, outcome] : result["tried"].items()) {
            INFO(name);
            CHECK(outcome != "done");
        }
    CHECK(std::filesystem::exists(home + "/.cache/mesa_shader_cache/index"));
}

TEST_CASE("a worker can neither reach out nor write nor read what is not a scene") {
    const farol::test::TemporaryFolder folder("worker-sandbox");
    folder.write("scenes/a.xml", "<world/>");
    folder.write("secret", "of somebody");
    const std::string scenes = folder.path() + "/scenes", secret = folder.path() + "/secret";
    const std::string home = folder.path() + "/home";
    const auto said = selfTest(scenes, secret, home);
    INFO(said);
    CHECK(said["before"] == "done");
    CHECK(said["draws"] == true);
    CHECK(said["readsOpenExr"] == 128);
    CHECK(said["reads"][scenes] == "done");
    const auto layers = said["layers"];
    const bool landlock = layers.value("landlock", "missing").rfind("abi", 0) == 0;
    const bool seccomp = layers.value("seccomp", "missing") == "on";
    for (const auto& [what, came] : said["tried"].items()) {
        const bool reads = what.rfind("read", 0) == 0;
        if (reads ? !landlock : !seccomp) continue;
        INFO(what);
        CHECK(came != "done");
    }
    CHECK(said["tried"].size() >= 20);
    checkForbiddenCalls(said);
    // Mesa found its cache, without which every start compiles all shaders.
    CHECK(std::filesystem::exists(home + "/.cache/mesa_shader_cache/index"));
    std::ifstream secretFile(secret);
    std::string content;
    std::getline(secretFile, content);
    CHECK(content == "of somebody");
    if (!landlock) test::skipMissing("the kernel has no Landlock: " + layers.dump());
    if (!seccomp) test::skipMissing("the kernel has no seccomp filters: " + layers.dump());
}
