#include "worker/queue.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "tests/support/errors.h"

using namespace farol;
using namespace farol::worker;
using namespace std::chrono_literals;

namespace {

struct Nobody {};

/// A worker that can be held, to fill the queue behind it.
struct Pool {
    explicit Pool(worker::QueueLimits limits, int workers = 1) : queue(limits) {
        for (int i = 0; i < workers; ++i)
            threads.emplace_back([this] {
                Nobody self;
                worker::JobQueue<Nobody>::Seat seat;
                while (queue.workOnce(self, seat)) {
                }
            });
        while (queue.state().workers < workers) std::this_thread::yield();
    }
    ~Pool() {
        queue.close();
        for (std::thread& thread : threads) thread.join();
    }
    worker::JobQueue<Nobody> queue;
    std::vector<std::thread> threads;
};

int run(Pool& pool, std::function<int()> work) {
    return pool.queue.run<int>([work = std::move(work)](Nobody&) { return work(); }).result;
}

}  // namespace

TEST_CASE("results and exceptions come back") {
    Pool pool({4, 10s, 10s});
    CHECK(run(pool, [] { return 42; }) == 42);
    CHECK_THROWS_AS(run(pool, []() -> int { throw test::errorOf("scene.empty", "none"); }), Error);
    CHECK(run(pool, [] { return 43; }) == 43);
}

TEST_CASE("a full queue refuses at once") {
    Pool pool({2, 10s, 10s});
    std::atomic<bool> release{false};
    const auto hold = [&] {
        while (!release) std::this_thread::sleep_for(1ms);
        return 1;
    };
    std::atomic<int> served{0};
    std::vector<std::thread> clients;
    for (int i = 0; i < 3; ++i) {
        clients.emplace_back([&] { served += run(pool, hold); });
        // One is worked on, the next wait: each has its place before the next comes.
        while (pool.queue.state().busy != 1 || pool.queue.state().queued != i)
            std::this_thread::yield();
    }
    CHECK_THROWS_AS(pool.queue.expectRoom({}), worker::Busy);
    try {
        run(pool, [] { return 2; });
        FAIL("the fourth job was taken");
    } catch (const worker::Busy& busy) {
        CHECK(busy.code() == "busy.queue");
        CHECK(busy.retryAfterS() >= 1);
    }
    release = true;
    for (std::thread& client : clients) client.join();
    CHECK(served == 3);
    CHECK_NOTHROW(pool.queue.expectRoom({}));
    CHECK(run(pool, [] { return 3; }) == 3);
}

TEST_CASE("a job that nobody takes in time is withdrawn and never run") {
    Pool pool({2, 20ms, 10s});
    std::atomic<bool> release{false}, started{false}, ran{false};
    std::thread client([&] {
        run(pool, [&] {
            started = true;
            while (!release) std::this_thread::sleep_for(1ms);
            return 1;
        });
    });
    while (!started) std::this_thread::yield();
    try {
        run(pool, [&] {
            ran = true;
            return 2;
        });
        FAIL("the second job was done");
    } catch (const worker::Busy& busy) {
        CHECK(busy.code() == "busy.queue");
    }
    CHECK(pool.queue.state().queued == 0);
    release = true;
    client.join();
    CHECK(run(pool, [] { return 3; }) == 3);
    CHECK_FALSE(ran);
}

TEST_CASE("a job past its deadline is given up without harm to the worker") {
    Pool pool({2, 10s, 20ms});
    std::atomic<bool> release{false};
    try {
        run(pool, [&release] {
            while (!release) std::this_thread::sleep_for(1ms);
            return 1;
        });
        FAIL("the job was done");
    } catch (const worker::Busy& busy) {
        CHECK(busy.code() == "busy.deadline");
    }
    release = true;
}

TEST_CASE("closing refuses those that wait and ends those that run") {
    Pool pool({2, 10s, 10s});
    std::atomic<bool> release{false}, started{false};
    std::atomic<int> first{0}, refused{0};
    std::thread running([&] {
        first = run(pool, [&] {
            started = true;
            while (!release) std::this_thread::sleep_for(1ms);
            return 7;
        });
    });
    while (!started) std::this_thread::yield();
    std::thread waiting([&] {
        try {
            run(pool, [] { return 8; });
        } catch (const worker::Busy& busy) {
            if (busy.code() == "busy.draining") ++refused;
        }
    });
    while (pool.queue.state().queued < 1) std::this_thread::yield();
    pool.queue.close();
    waiting.join();
    release = true;
    running.join();
    CHECK(first == 7);
    CHECK(refused == 1);
    CHECK_THROWS_AS(run(pool, [] { return 9; }), worker::Busy);
}

TEST_CASE("of a session only the newest frame waits") {
    Pool pool({4, 10s, 10s});
    std::atomic<bool> release{false};
    std::atomic<int> drawn{0};
    const auto frame = [&](const std::string& session, std::int64_t seq) -> std::string {
        try {
            pool.queue.run<int>(
                [&](Nobody&) {
                    while (!release) std::this_thread::sleep_for(1ms);
                    return ++drawn;
                },
                "", {session, seq});
            return "drawn";
        } catch (const worker::Busy& busy) {
            return busy.code();
        }
    };
    const auto waitFor = [&](int busy, int queued) {
        while (pool.queue.state().busy != busy || pool.queue.state().queued != queued)
            std::this_thread::yield();
    };
    std::string first, second, third, other;
    std::thread a([&] { first = frame("one", 1); });
    waitFor(1, 0);  // being worked on: it is not taken back
    std::thread b([&] { second = frame("one", 2); });
    waitFor(1, 1);
    std::thread c([&] { other = frame("two", 1); });
    waitFor(1, 2);
    std::thread d([&] { third = frame("one", 3); });
    b.join();  // at once, not when its turn comes
    CHECK(second == "busy.superseded");
    waitFor(1, 2);
    CHECK(frame("one", 2) == "busy.superseded");  // it arrives late
    release = true;
    for (std::thread* one : {&a, &c, &d}) one->join();
    CHECK(first == "drawn");
    CHECK(third == "drawn");
    CHECK(other == "drawn");
    CHECK(drawn == 3);
    CHECK(frame("one", 3) == "drawn");  // the same frame again is not an older one
    CHECK(pool.queue.state().superseded == 2);
}
