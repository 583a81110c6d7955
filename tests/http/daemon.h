#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/support/paths.h"

namespace farol::test {

/// The options of a Daemon.
struct Start {
    rlim_t fileBytes = 0;    ///< largest file that it may write; 0: no limit
    rlim_t descriptors = 0;  ///< soft and hard limit; 0: that of the test
    std::string closed{};    ///< of "0", "1" and "2", the descriptors that are closed
    int stderrFd = -1;       ///< instead of /dev/null
};

/// `farol serve` with these arguments; its stdout is read, its stderr goes to /dev/null.
class Daemon {
  public:
    explicit Daemon(const std::vector<std::string>& arguments, const Start& start = {}) {
        int ends[2];
        REQUIRE(pipe2(ends, O_CLOEXEC) == 0);
        std::vector<std::string> words = {farol::test::kProgram, "serve"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        std::vector<char*> argv;
        for (std::string& word : words) argv.push_back(word.data());
        argv.push_back(nullptr);
        pid_ = fork();
        REQUIRE(pid_ >= 0);
        if (pid_ == 0) {
            dup2(ends[1], 1);
            dup2(start.stderrFd >= 0 ? start.stderrFd : open("/dev/null", O_WRONLY), 2);
            const auto limit = [](auto resource, rlim_t value) {
                const rlimit both{value, value};
                if (value > 0) setrlimit(resource, &both);
            };
            limit(RLIMIT_FSIZE, start.fileBytes);
            limit(RLIMIT_NOFILE, start.descriptors);
            for (const char fd : start.closed) close(fd - '0');
            execv(argv[0], argv.data());
            _exit(127);
        }
        close(ends[1]);
        out_ = ends[0];
    }
    ~Daemon() {
        if (pid_ > 0) {
            kill(pid_, SIGKILL);
            waitpid(pid_, nullptr, 0);
        }
        close(out_);
    }

    std::string firstLine() {
        std::string line;
        char c = 0;
        while (read(out_, &c, 1) == 1 && c != '\n') line += c;
        return line;
    }
    pid_t pid() const { return pid_; }
    void signal(int number) const { kill(pid_, number); }
    /// Waits for the end: the exit code, or 128 and the signal's number.
    int exitCode() {
        int status = 0;
        waitpid(pid_, &status, 0);
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

  private:
    pid_t pid_ = -1;
    int out_ = -1;
};

inline int portIn(const std::string& line) {
    const std::string start = "listening on http://127.0.0.1:";
    INFO(line);
    REQUIRE(line.rfind(start, 0) == 0);
    return std::stoi(line.substr(start.size()));
}

}  // namespace farol::test
