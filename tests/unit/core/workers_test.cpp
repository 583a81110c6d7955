#include "core/workers.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <stdexcept>

using farol::Workers;

TEST_CASE("workers run tasks in the order in which they are added, and hand back what they give") {
    for (const std::size_t threads : {0U, 1U, 3U}) {
        Workers workers(threads);
        CHECK(workers.size() == threads);
        std::vector<std::future<int>> results;
        std::atomic<int> begun = 0;
        for (int i = 0; i < 50; ++i)
            results.push_back(workers.add([&begun, i] {
                const int place = begun++;
                return i - place;
            }));
        for (std::future<int>& result : results) {
            const int ahead = result.get();
            if (threads < 2) CHECK(ahead == 0);
        }
        CHECK(begun == 50);
        CHECK_THROWS_AS(workers.add([]() -> int { throw std::runtime_error("x"); }).get(),
                        std::runtime_error);
    }
}

TEST_CASE("workers that end finish what runs and leave out the rest") {
    std::future<int> running, waiting;
    std::promise<void> begun, end;
    {
        Workers workers(1);
        running = workers.add([&] {
            begun.set_value();
            end.get_future().wait();
            return 1;
        });
        waiting = workers.add([] { return 2; });
        begun.get_future().wait();
        end.set_value();
        // The second may begin before the end is asked for.
    }
    CHECK(running.get() == 1);
    try {
        const int result = waiting.get();
        CHECK(result == 2);
    } catch (const std::future_error& error) {
        CHECK(error.code() == std::future_errc::broken_promise);
    }
}
