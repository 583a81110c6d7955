#include "server/log.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <vector>

using namespace farol::server;

TEST_CASE("lines of many threads are all in the log, once and whole") {
    constexpr int kThreads = 8, kLines = 2000;
    std::vector<std::string> lines;  // one thread writes at a time: no lock here, on purpose
    {
        Logger logger([&](const std::string& line) { lines.push_back(line); });
        std::vector<std::thread> threads;
        for (int t = 0; t < kThreads; ++t)
            threads.emplace_back([&, t] {
                for (int i = 0; i < kLines; ++i)
                    logger.event("turn", std::to_string(t) + " " + std::to_string(i));
            });
        for (std::thread& thread : threads) thread.join();
    }
    REQUIRE(lines.size() == kThreads * kLines);
    std::set<std::string> said;
    std::vector<int> last(kThreads, -1);
    bool inOrder = true;
    for (const std::string& line : lines) {
        const auto event = nlohmann::json::parse(line, nullptr, false);
        REQUIRE(event.is_object());
        const std::string message = event.value("message", "");
        said.insert(message);
        // The lines of one thread stay in order.
        const auto thread = static_cast<std::size_t>(std::stoi(message));
        const int number = std::stoi(message.substr(message.find(' ')));
        inOrder = inOrder && number == last.at(thread) + 1;
        last.at(thread) = number;
    }
    CHECK(said.size() == kThreads * kLines);
    CHECK(inOrder);
}
