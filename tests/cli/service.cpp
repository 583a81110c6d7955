#include "service.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "run.h"
#include "tests/support/paths.h"

namespace farol::test {

Service::Service() {
    int ends[2];
    REQUIRE(::pipe2(ends, O_CLOEXEC) == 0);
    output_ = ends[0];
    const std::string scenes = std::string(farol::test::kSourceDir) + "/scenes",
                      log = folder().string() + ".service.log";
    std::string words[] = {farol::test::kProgram, "serve", "--port", "0", "--scenes", scenes};
    char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), words[3].data(),
                         words[4].data(), words[5].data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, log.c_str(),
                                     O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const int failed =
        ::posix_spawn(&process_, farol::test::kProgram, &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    REQUIRE(failed == 0);
    std::string line;  // ends with the pipe where the program could not start
    for (char c = 0; ::read(output_, &c, 1) == 1 && c != '\n';) line += c;
    INFO(line);
    REQUIRE(line.find("http://") != std::string::npos);
    url_ = line.substr(line.find("http://"));
}

Service::~Service() {
    if (process_ > 0) {
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
    }
    if (output_ >= 0) ::close(output_);
}

int Service::stop() {
    int status = 0;
    ::kill(process_, SIGTERM);
    REQUIRE(::waitpid(process_, &status, 0) == process_);
    process_ = -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace farol::test
