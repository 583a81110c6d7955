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

#include "image/image_file.h"
#include "worker/attempts.h"
#include "worker/job.h"
#include "worker/jobs.h"
#include "worker/tasks/check.h"
#include "worker/worker.h"

namespace farol::worker {
namespace {

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

/// An OpenEXR file of one grey pixel, without compression.
std::string greyExr() {
    using namespace std::string_literals;
    const auto attribute = [](const std::string& name, const std::string& type,
                              const std::string& value) {
        return name + '\0' + type + '\0' + static_cast<char>(value.size()) + "\0\0\0"s + value;
    };
    const std::string one = "\1\0\0\0"s, oneFloat = "\0\0\x80\x3f"s;
    const std::string head =
        "\x76\x2f\x31\x01\2\0\0\0"s +
        attribute("channels", "chlist", "Y\0\2\0\0\0\0\0\0\0"s + one + one + '\0') +
        attribute("compression", "compression", "\0"s) +
        attribute("dataWindow", "box2i", std::string(16, '\0')) +
        attribute("displayWindow", "box2i", std::string(16, '\0')) +
        attribute("lineOrder", "lineOrder", "\0"s) +
        attribute("pixelAspectRatio", "float", oneFloat) +
        attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
        attribute("screenWindowWidth", "float", oneFloat) + '\0';
    const std::size_t chunk = head.size() + 8;
    return head + static_cast<char>(chunk & 255U) + static_cast<char>(chunk >> 8U) +
           std::string(6, '\0') + "\0\0\0\0\4\0\0\0\0\0\0\x3f"s;
}

std::string connected(int family) {
    const int fd = socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    std::string said = outcome(fd);
    if (fd >= 0) close(fd);
    return said;
}

}  // namespace

int runSelfTest(const SandboxOptions& options, const std::string& probe, bool asCommandLine) {
    nlohmann::json said = {{"before", opened(probe, O_RDONLY)}};
    Layers layers;
    if (asCommandLine)
        layers = closeCommandLine(options);
    else
        enterSandbox(options, layers);
    WorkerState state(0.0, render::GlSource::automatic);
    warmUp(state.renderer);
    if (!asCommandLine) closeSandbox(options, layers);
    for (const auto& [name, layer] : layers) said["layers"][name] = layer;

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

    for (const auto& [name, result] : tryForbiddenCalls()) said["calls"][name] = result;

    // Rendering and reading the scenes' files still work.
    const PackedJob canary = packJob<CheckTask>({});
    said["draws"] = readAnswer(work(state, canary.bytes), canary).outcome == Outcome::done;
    try {
        // Loads a module and its libraries.
        said["readsOpenExr"] = image::decodeImage(greyExr(), "grey.exr").pixels[0];
    } catch (const Error& error) {
        said["readsOpenExr"] = error.what();
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

}  // namespace farol::worker
