#include "server/queue.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

using namespace farol;
using namespace farol::server;
using namespace std::chrono_literals;

namespace {

struct Nobody {};

/// A worker that can be held, to fill the queue behind it.
struct Pool {
    explicit Pool(QueueLimits limits, int workers = 1) : queue(limits) {
        for (int i = 0; i < workers; ++i)
            threads.emplace_back([this] {
                Nobody self;
                JobQueue<Nobody>::Seat seat;
                while (queue.workOnce(self, seat)) {
                }
            });
        while (queue.state().workers < workers) std::this_thread::yield();
    }
    ~Pool() {
        queue.close();
        for (std::thread& thread : threads) thread.join();
    }
    JobQueue<Nobody> queue;
    std::vector<std::thread> threads;
};

int run(Pool& pool, std::function<int()> work) {
    return pool.queue.run<int>([work = std::move(work)](Nobody&) { return work(); }).result;
}

}  // namespace

TEST_CASE("results and exceptions come back") {
    Pool pool({4, 10s, 10s});
    CHECK(run(pool, [] { return 42; }) == 42);
    CHECK_THROWS_AS(run(pool, []() -> int { throw Error("scene.empty", "none"); }), Error);
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
    try {
        run(pool, [] { return 2; });
        FAIL("the fourth job was taken");
    } catch (const Busy& busy) {
        CHECK(busy.code() == "busy.queue");
        CHECK(busy.retryAfterS() >= 1);
    }
    release = true;
    for (std::thread& client : clients) client.join();
    CHECK(served == 3);
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
    } catch (const Busy& busy) {
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
    } catch (const Busy& busy) {
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
        } catch (const Busy& busy) {
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
    CHECK_THROWS_AS(run(pool, [] { return 9; }), Busy);
}
