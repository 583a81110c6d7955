#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "run.h"
#include "tests/support/paths.h"

namespace farol::test {

inline std::string textOf(const std::string& path) {
    std::ifstream in(path);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// `farol` with these arguments in the test's folder, while it runs, in a process group of its
/// descendants.
class Running {
  public:
    explicit Running(std::vector<std::string> words) {
        words.insert(words.begin(), kProgram);
        std::vector<char*> arguments;
        for (std::string& word : words) arguments.push_back(word.data());
        arguments.push_back(nullptr);
        const std::string out = (folder() / "stdout").string(),
                          err = (folder() / "stderr").string();
        pid_ = fork();
        REQUIRE(pid_ >= 0);
        if (pid_ == 0) {
            setpgid(0, 0);
            dup2(open(out.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600), 1);
            dup2(open(err.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600), 2);
            if (chdir(folder().c_str()) == 0) execv(arguments[0], arguments.data());
            _exit(127);
        }
        setpgid(pid_, pid_);
    }
    ~Running() {
        if (pid_ > 0) {
            kill(pid_, SIGKILL);
            waitpid(pid_, nullptr, 0);
        }
    }
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    pid_t pid() const { return pid_; }
    /// The first `count` processes that read the files, in the order of their start; waits for them
    /// to exist and to be closed in by seccomp.
    std::vector<pid_t> confined(std::size_t count) const {
        const std::string children =
            "/proc/" + std::to_string(pid_) + "/task/" + std::to_string(pid_) + "/children";
        for (;;) {
            REQUIRE(waitpid(pid_, nullptr, WNOHANG) == 0);
            std::istringstream list(textOf(children));
            std::vector<pid_t> found;
            for (pid_t child = 0; found.size() < count && list >> child;)
                if (statusOf(child).find("Seccomp:\t2") != std::string::npos)
                    found.push_back(child);
            if (found.size() == count) return found;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    pid_t confined() const { return confined(1).front(); }
    static std::string statusOf(pid_t process) {
        return textOf("/proc/" + std::to_string(process) + "/status");
    }
    /// Waits for the end: the exit code, or 128 and the signal's number.
    int end() {
        int status = 0;
        waitpid(pid_, &status, 0);
        pid_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

  private:
    pid_t pid_ = -1;
};

/// Names of the files in the test's folder that are neither its scene nor its streams.
inline std::vector<std::string> leftFiles() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder())) {
        const std::string name = entry.path().filename().string();
        if (name != "scene.xml" && name != "stdout" && name != "stderr") names.push_back(name);
    }
    return names;
}

}  // namespace farol::test
