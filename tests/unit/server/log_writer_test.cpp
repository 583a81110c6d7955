#include "server/log_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <sstream>
#include <string>
#include <thread>

using farol::server::LogWriter;

namespace {

struct Pipe {
    Pipe() { REQUIRE(pipe2(ends.data(), O_CLOEXEC) == 0); }
    ~Pipe() {
        for (int& end : ends)
            if (end >= 0) close(end);
    }
    static void close(int& end) {
        ::close(end);
        end = -1;
    }
    std::string readAll() {
        std::string all;
        std::array<char, 4096> bytes;
        for (ssize_t got = 0; (got = read(ends[0], bytes.data(), bytes.size())) > 0;)
            all.append(bytes.data(), static_cast<std::size_t>(got));
        return all;
    }
    std::array<int, 2> ends{-1, -1};
};

LogWriter::Options bounded() {
    LogWriter::Options options;
    options.queueBytes = 1000;
    options.patience = std::chrono::milliseconds(50);
    options.notice = [](std::uint64_t count) { return "dropped " + std::to_string(count); };
    return options;
}

}  // namespace

TEST_CASE("a log that nobody reads blocks nobody; lines are dropped, counted and reported") {
    constexpr int kLines = 20'000;  // more than pipe and queue hold
    Pipe pipe;
    LogWriter::Options options = bounded();
    options.patience = std::chrono::seconds(60);
    std::string text;
    std::uint64_t dropped = 0;
    {
        std::thread reader;
        {
            LogWriter log(pipe.ends[1], options);
            for (int i = 0; i < kLines; ++i) log.write("line " + std::to_string(i));
            dropped = log.dropped();
            CHECK(dropped > 0);
            reader = std::thread([&] { text = pipe.readAll(); });
        }
        pipe.close(pipe.ends[1]);
        reader.join();
    }
    std::istringstream lines(text);
    std::uint64_t seen = 0, reported = 0;
    int last = -1;
    for (std::string line; std::getline(lines, line);) {
        if (line.rfind("dropped ", 0) == 0) {
            reported += std::stoul(line.substr(8));
            continue;
        }
        REQUIRE(line.rfind("line ", 0) == 0);
        const int number = std::stoi(line.substr(5));
        CHECK(number > last);
        last = number;
        ++seen;
    }
    CHECK(seen + dropped == kLines);
    CHECK(reported <= dropped);
}

TEST_CASE("a log writer ends while its reader is stuck") {
    Pipe pipe;
    for (const int flags : {0, O_NONBLOCK}) {
        fcntl(pipe.ends[1], F_SETFL, flags);
        LogWriter log(pipe.ends[1], bounded());
        for (int i = 0; i < 200'000; ++i) log.write("a line that nobody reads");
        CHECK(log.dropped() > 0);
    }
    SUCCEED("both have ended");
}

TEST_CASE("a log survives a reader that has gone, and a descriptor that is closed") {
    Pipe pipe;
    pipe.close(pipe.ends[0]);
    for (const int fd : {pipe.ends[1], 1000}) {
        LogWriter log(fd, bounded());
        log.write("to nobody");
        while (log.dropped() == 0) std::this_thread::yield();
        log.write("to nobody again");
        while (log.dropped() < 2) std::this_thread::yield();
    }
}

TEST_CASE("a log has all its lines at the end, however long they are") {
    Pipe pipe;
    std::string text;
    std::thread reader([&] { text = pipe.readAll(); });
    LogWriter::Options options;
    options.patience = std::chrono::seconds(60);
    const std::string longLine(50'000, 'x');
    {
        LogWriter log(pipe.ends[1], options);
        for (int i = 0; i < 10; ++i) {
            log.write(longLine);
            log.write("short");
        }
        CHECK(log.dropped() == 0);
    }
    pipe.close(pipe.ends[1]);
    reader.join();
    CHECK(text.size() == 10 * (longLine.size() + 1 + 6));
}
