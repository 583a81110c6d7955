#include "server/animation_probe.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "core/text.h"
#include "image/animation.h"

namespace farol::server {
namespace {

constexpr unsigned kMaxSeconds = 10;

[[noreturn]] void probe(int pipe) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    alarm(kMaxSeconds);
    std::string text;
    for (const std::string& name : image::writableAnimations()) text += name + "\n";
    const bool isSent = write(pipe, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    _exit(isSent ? 0 : 1);
}

}  // namespace

AnimationProbe::AnimationProbe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw std::runtime_error(std::string("no pipe for a process: ") + std::strerror(errno));
    child_ = fork();
    if (child_ == 0) probe(ends[1]);
    close(ends[1]);
    pipe_ = ends[0];
    if (child_ < 0)
        throw std::runtime_error(std::string("cannot start a process: ") + std::strerror(errno));
}

AnimationProbe::~AnimationProbe() {
    close(pipe_);
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    while (waitpid(child_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

std::vector<std::string> AnimationProbe::names() {
    std::string text;
    char block[256];
    for (ssize_t got = 1; got != 0;) {
        got = read(pipe_, block, sizeof block);
        if (got < 0 && errno != EINTR) break;
        if (got > 0) text.append(block, static_cast<std::size_t>(got));
    }
    int status = 0;
    while (waitpid(child_, &status, 0) < 0 && errno == EINTR) {
    }
    child_ = -1;
    std::vector<std::string> names;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
        for (const std::string_view name : split(text, "\n")) names.emplace_back(name);
    } else {
        for (const image::AnimationSpec& format : image::kAnimations)
            if (!format.needsModule) names.emplace_back(format.name);
    }
    return names;
}

}  // namespace farol::server
