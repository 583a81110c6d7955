#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sched.h>
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <thread>

#include "render/image_file.h"
#include "server/worker/jobs.h"
#include "server/worker/worker.h"

namespace farol::server::worker {
namespace {

std::string outcome(long result) {
    if (result >= 0) return "done";
    const char* name = strerrorname_np(errno);
    return name == nullptr ? std::to_string(errno) : name;
}

std::string opened(const std::string& path, int flags) {
    const int fd = open(path.c_str(), flags | O_CLOEXEC, 0600);
    std::string said = outcome(fd);
    if (fd >= 0) close(fd);
    return said;
}

std::string forked() {
    const pid_t child = fork();
    if (child == 0) _exit(0);
    const std::string said = outcome(child);
    if (child > 0) waitpid(child, nullptr, 0);
    return said;
}

std::string executed() {
    char name[] = "/bin/true";
    char* const arguments[] = {name, nullptr};
    execv(name, arguments);  // returns only when it is refused
    return outcome(-1);
}

std::string connected(int family) {
    const int fd = socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    std::string said = outcome(fd);
    if (fd >= 0) close(fd);
    return said;
}

}  // namespace

int runSelfTest(const SandboxOptions& options, const std::string& probe) {
    nlohmann::json said = {{"before", opened(probe, O_RDONLY)}};
    Layers layers;
    enterSandbox(options, layers);
    render::Renderer renderer;
    warmUp(renderer);
    closeSandbox(options, layers);
    for (const auto& [name, state] : layers) said["layers"][name] = state;

    nlohmann::json& tried = said["tried"];
    tried["socketInet"] = connected(AF_INET);
    tried["socketUnix"] = connected(AF_UNIX);
    int pair[2];
    tried["socketpair"] = outcome(socketpair(AF_UNIX, SOCK_STREAM, 0, pair));
    const sockaddr_in nowhere{};
    tried["connect"] =
        outcome(connect(0, reinterpret_cast<const sockaddr*>(&nowhere), sizeof nowhere));
    tried["readPasswd"] = opened("/etc/passwd", O_RDONLY);
    tried["readProbe"] = opened(probe, O_RDONLY);
    std::thread([&] { tried["readPasswdFromThread"] = opened("/etc/passwd", O_RDONLY); }).join();
    tried["readEnvironment"] = opened("/proc/self/environ", O_RDONLY);
    tried["writeProbe"] = opened(probe, O_WRONLY);
    tried["truncateProbe"] = outcome(truncate(probe.c_str(), 0));
    tried["createBeside"] = opened(probe + ".new", O_WRONLY | O_CREAT);
    tried["createInTmp"] = opened("/tmp/farol-self-test", O_WRONLY | O_CREAT);
    tried["unlinkProbe"] = outcome(unlink(probe.c_str()));
    tried["renameProbe"] = outcome(rename(probe.c_str(), (probe + ".moved").c_str()));
    tried["mkdir"] = outcome(mkdir((probe + ".folder").c_str(), 0700));
    tried["fork"] = forked();
    tried["execute"] = executed();
    tried["trace"] = outcome(ptrace(PTRACE_TRACEME, 0, nullptr, nullptr));
    tried["signalParent"] = outcome(kill(getppid(), 0));
    const rlimit more{RLIM_INFINITY, RLIM_INFINITY};
    tried["raiseLimit"] = outcome(setrlimit(RLIMIT_DATA, &more));
    tried["namespace"] = outcome(unshare(CLONE_NEWUSER));

    // What it is for still works: a picture, and the files of the scenes.
    Request canary;
    grade::Grader grader(renderer);
    said["draws"] = work(renderer, grader, canary).outcome == Outcome::done;
    try {
        render::decodeImage("P6\n1 1\n255\nabc", "rare.ppm");
        said["readsRarePictures"] = true;
    } catch (const Error& error) {
        said["readsRarePictures"] = error.what();
    }
    for (const std::string& folder : options.readable) {
        std::error_code failed;
        std::string read = "nothing to read";
        for (const auto& entry : std::filesystem::directory_iterator(folder, failed))
            if (entry.is_regular_file()) read = opened(entry.path().string(), O_RDONLY);
        said["reads"][folder] = failed ? failed.message() : read;
    }
    std::printf("%s\n", said.dump(2).c_str());
    std::fflush(stdout);
    _exit(0);
}

}  // namespace farol::server::worker
