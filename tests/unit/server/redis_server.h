#pragma once

#include <arpa/inet.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "server/store/redis_link.h"
#include "tests/support/paths.h"
#include "tests/support/skip.h"

namespace farol::test {

/// A Redis server on a free port, with its data in a folder for it alone. Skips the test where the
/// program is not installed.
class RedisServer {
  public:
    RedisServer() {
        // Debian's redis-tools has the server under another name, and starts no service.
        for (const char* path : {"/usr/bin/redis-server", "/usr/bin/redis-check-rdb"})
            if (program_.empty() && access(path, X_OK) == 0) program_ = path;
        if (program_.empty()) skipMissing("no redis-server (package redis-tools)");
        folder_ =
            std::filesystem::path(farol::test::kTestOutput) / ("redis-" + std::to_string(getpid()));
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
        port_ = freePort();
        start();
    }
    ~RedisServer() {
        stop();
        std::error_code ignored;
        if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
    }
    server::store::RedisAddress address() const { return {"127.0.0.1", port_, "", "", 0}; }

    void start(const std::vector<std::string>& more = {}) {
        std::vector<std::string> words = {"redis-server",
                                          "--port",
                                          std::to_string(port_),
                                          "--bind",
                                          "127.0.0.1",
                                          "--dir",
                                          folder_,
                                          "--appendonly",
                                          "yes",
                                          "--appendfsync",
                                          "always",
                                          "--save",
                                          "",
                                          "--loglevel",
                                          "warning",
                                          "--logfile",
                                          "/dev/null"};
        words.insert(words.end(), more.begin(), more.end());
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        pid_ = fork();
        REQUIRE(pid_ >= 0);
        if (pid_ == 0) {
            prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that fails here leaves no server behind
            execv(program_.c_str(), argv.data());
            _exit(127);
        }
        server::store::RedisLink link(address(), [](const std::string&) {});
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        for (bool up = false; !up;) {
            try {
                up = link.ask({"PING"}).text == "PONG";
            } catch (const server::store::RedisAway&) {
                REQUIRE(std::chrono::steady_clock::now() < end);
                std::this_thread::sleep_for(std::chrono::milliseconds(50));
            }
        }
    }
    /// As the kernel ends it: without a word.
    void stop() {
        if (pid_ <= 0) return;
        kill(pid_, SIGKILL);
        waitpid(pid_, nullptr, 0);
        pid_ = -1;
    }

  private:
    static int freePort() {
        const int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        auto* generic = reinterpret_cast<sockaddr*>(&address);
        REQUIRE(bind(fd, generic, size) == 0);
        REQUIRE(getsockname(fd, generic, &size) == 0);
        close(fd);
        return ntohs(address.sin_port);
    }

    std::string program_, folder_;
    int port_ = 0;
    pid_t pid_ = -1;
};

}  // namespace farol::test
