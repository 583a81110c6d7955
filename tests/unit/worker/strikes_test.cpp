// The cause of a lost worker: the request, the scene, or neither.
#include <signal.h>

#include <atomic>
#include <thread>

#include "fake.h"
#include "worker/process_usage.h"
#include "worker/tasks/inspect.h"

using namespace farol;
using namespace farol::worker;
using namespace farol::test;
using namespace std::chrono_literals;

namespace {

/// A request whose worker is stopped before it can begin, then hit by `signal`.
std::string codeWhenHit(WorkerPool& pool, const std::string& deed, int signal) {
    const pid_t pid = workerOf(pool);
    kill(pid, SIGSTOP);
    std::string code;
    std::thread client([&] { code = renderCode(pool, deed); });
    while (pool.state().busy == 0) std::this_thread::sleep_for(1ms);
    kill(pid, signal);
    client.join();
    return code;
}

}  // namespace

TEST_CASE("a request that runs into its deadline twice is closed, its scene is not") {
    PoolOptions options = fakeOptions();
    options.queue.deadline = 1500ms;
    options.cpu = 60s;
    WorkerPool pool(options, noLog());
    for (int i = 0; i < 2; ++i) {
        workerOf(pool);
        CHECK(renderCode(pool, "hang", 1) == "busy.deadline");
    }
    CHECK(restarts(pool, "deadline") == 2);
    CHECK(renderCode(pool, "hang", 1) == "worker.quarantine");
    // Other options of the same scene are tried, however many of them fail.
    for (int variant = 2; variant < 5; ++variant) {
        workerOf(pool);
        CHECK(renderCode(pool, "hang", variant) == "busy.deadline");
    }
    workerOf(pool);
    CHECK(renderCode(pool, "image") == "done");
}

TEST_CASE("processor time beyond --cpu ends the worker and counts against the request") {
    PoolOptions options = fakeOptions();
    options.cpu = 200ms;
    WorkerPool pool(options, noLog());
    for (int i = 0; i < 2; ++i) CHECK(renderCode(pool, "spin") == "limit.cpu");
    CHECK(restarts(pool, "cpu") == 2);
    CHECK(renderCode(pool, "spin") == "worker.quarantine");
    CHECK(renderCode(pool, "spin", 2) == "limit.cpu");
    CHECK(renderCode(pool, "image") == "done");
}

TEST_CASE("a memory failure counts against the request, not the scene") {
    WorkerPool pool(fakeOptions(), noLog());
    for (int i = 0; i < 2; ++i) CHECK(renderCode(pool, "memory") == "limit.memory");
    CHECK(restarts(pool, "memory") == 2);
    CHECK(renderCode(pool, "memory") == "worker.quarantine");
    CHECK(renderCode(pool, "memory", 2) == "limit.memory");
}

TEST_CASE("crashes by three different requests close the scene for all") {
    WorkerPool pool(fakeOptions(), noLog());
    CHECK(renderCode(pool, "abort", 1) == "worker.crashed");
    CHECK(renderCode(pool, "abort", 1) == "worker.crashed");
    CHECK(renderCode(pool, "abort", 1) == "worker.quarantine");  // the request alone
    CHECK(renderCode(pool, "abort", 2) == "worker.crashed");
    CHECK(renderCode(pool, "abort", 3) == "worker.crashed");
    CHECK(renderCode(pool, "abort", 4) == "worker.quarantine");
    CHECK(codeOf([&] { pool.run<InspectTask>({jobOf("abort")}); }) == "worker.quarantine");
    CHECK(restarts(pool, "crash") == 4);
    CHECK(renderCode(pool, "image") == "done");
}

TEST_CASE("a worker that somebody stops or kills strikes nobody") {
    PoolOptions options = fakeOptions();
    options.queue.deadline = 1500ms;
    WorkerPool pool(options, noLog());
    for (int i = 1; i <= 3; ++i) {
        CHECK(codeWhenHit(pool, "image", SIGSTOP) == "busy.deadline");
        CHECK(restarts(pool, "stalled") == i);
        workerOf(pool);
        CHECK(renderCode(pool, "other") == "done");
    }
    CHECK(restarts(pool, "deadline") == 0);
    CHECK(renderCode(pool, "image") == "done");
}

TEST_CASE(
    "a worker killed by any signal that no fault raises is replaced and its job begun again") {
    WorkerPool pool(fakeOptions(), noLog());
    long killed = 0;
    for (const int signal : {SIGKILL, SIGUSR1, SIGALRM}) {
        const pid_t pid = workerOf(pool);
        kill(pid, SIGSTOP);
        std::string code;
        std::thread client([&] { code = renderCode(pool, "image"); });
        while (pool.state().busy == 0) std::this_thread::sleep_for(1ms);
        kill(pid, signal);
        kill(pid, SIGCONT);
        client.join();
        CHECK(code == "done");
        // It may be found dead just before the job is sent to it.
        CHECK(restarts(pool, "killed") + restarts(pool, "idle") == ++killed);
    }
    CHECK(restarts(pool, "crash") == 0);
}

TEST_CASE("the kernel tells a process's time and what it waits for") {
    CHECK(cpuTimeOf(getpid()).count() > 0);
    CHECK(cpuTimeOf(-1).count() == 0);
    CHECK(activityOf(getpid()) == Activity::runnable);
    PoolOptions options = fakeOptions();
    WorkerPool pool(options, noLog());
    const pid_t pid = workerOf(pool);
    while (activityOf(pid) != Activity::blocked) std::this_thread::sleep_for(1ms);
    kill(pid, SIGSTOP);
    while (activityOf(pid) != Activity::stopped) std::this_thread::sleep_for(1ms);
    kill(pid, SIGCONT);
}

TEST_CASE("quarantine ends by time, forgets with a success, and is bounded") {
    using Cause = Quarantine::Cause;
    Quarantine quarantine(60s);
    const auto start = Quarantine::Clock::now();
    const auto left = [&](const std::string& scene, const std::string& request,
                          std::chrono::seconds after = 0s) {
        return quarantine.closed({scene, request}, start + after).left.count();
    };
    quarantine.strike({"s", "a"}, Cause::exhausted, start);
    CHECK(left("s", "a") == 0);
    quarantine.strike({"s", "a"}, Cause::exhausted, start);
    CHECK(left("s", "a") == 60);
    CHECK(left("s", "b") == 0);
    CHECK(left("s", "a", 60s) == 0);
    CHECK(left("s", "a") == 0);  // forgotten
    quarantine.strike({"s", "c"}, Cause::exhausted, start);
    quarantine.success({"s", "c"});
    quarantine.strike({"s", "c"}, Cause::exhausted, start);
    CHECK(left("s", "c") == 0);
    quarantine.strike({"s", "d"}, Cause::exhausted, start);
    quarantine.strike({"s", "d"}, Cause::exhausted, start + 61s);  // the first is too long ago
    CHECK(left("s", "d", 61s) == 0);

    for (const char* request : {"1", "2"}) quarantine.strike({"t", request}, Cause::crash, start);
    quarantine.success({"t", "2"});
    quarantine.success({"t", "other"});  // says nothing of those that crashed
    quarantine.strike({"t", "3"}, Cause::crash, start);
    CHECK(left("t", "new") == 0);
    quarantine.strike({"t", "4"}, Cause::crash, start);
    CHECK(left("t", "new") == 60);
    CHECK(quarantine.closed({"t", "new"}, start).isScene);
    CHECK(left("t", "new", 60s) == 0);

    quarantine.strike({"", ""}, Cause::crash, start);  // jobs without an identity are exempt
    quarantine.strike({"", ""}, Cause::crash, start);
    CHECK(left("", "") == 0);
    for (std::size_t i = 0; i < Quarantine::kMaxEntries; ++i)
        quarantine.strike({"x", "x" + std::to_string(i)}, Cause::exhausted, start + 100s);
    quarantine.strike({"s", "d"}, Cause::exhausted, start + 100s);  // its first one had to go
    CHECK(left("s", "d", 100s) == 0);
}
