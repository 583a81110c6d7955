#include "server/worker/process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>
#include <vector>

#include "server/worker/sandbox.h"
#include "server/worker/wire.h"

namespace farol::server::worker {
namespace {

// What Mesa, the loader and the sanitizers read. Secrets of the service stay with it.
bool isPassedOn(std::string_view variable) {
    for (const char* start :
         {"HOME=", "XDG_CACHE_HOME=", "LD_LIBRARY_PATH=", "PATH=", "MESA_", "LP_", "GALLIUM_",
          "GALLIVM_", "ASAN_OPTIONS=", "UBSAN_OPTIONS=", "LSAN_OPTIONS=", "TSAN_OPTIONS="})
        if (variable.substr(0, std::strlen(start)) == start) return true;
    return false;
}

std::runtime_error failure(const char* what, int error) {
    return std::runtime_error(std::string(what) + ": " + std::strerror(error));
}

/// posix_spawn takes a vfork's way: no lock of another thread is inherited, and the program is
/// loaded anew.
pid_t spawn(const WorkerOptions& options, int socket) {
    std::vector<std::string> words = {"farol", "worker", "--memory",
                                      std::to_string(options.memoryBytes)};
    if (!options.scenesDir.empty()) words.insert(words.end(), {"--scenes", options.scenesDir});
    std::vector<char*> arguments, environment;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    for (char** one = environ; *one != nullptr; ++one)
        if (isPassedOn(*one)) environment.push_back(*one);
    environment.push_back(nullptr);

    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    if (posix_spawn_file_actions_init(&files) != 0 || posix_spawnattr_init(&attributes) != 0)
        throw std::bad_alloc();
    sigset_t none, all;
    sigemptyset(&none);
    sigfillset(&all);
    pid_t pid = -1;
    int error = posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    if (error == 0) error = posix_spawn_file_actions_adddup2(&files, options.said, 1);
    if (error == 0) error = posix_spawn_file_actions_adddup2(&files, options.said, 2);
    if (error == 0) error = posix_spawn_file_actions_adddup2(&files, socket, kSocket);
    if (error == 0) error = posix_spawn_file_actions_addclosefrom_np(&files, kSocket + 1);
    if (error == 0) error = posix_spawnattr_setsigmask(&attributes, &none);
    if (error == 0) error = posix_spawnattr_setsigdefault(&attributes, &all);
    if (error == 0)
        error =
            posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    if (error == 0)
        error = posix_spawn(&pid, options.program.c_str(), &files, &attributes, arguments.data(),
                            environment.data());
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    if (error != 0) throw failure("a worker cannot be started", error);
    return pid;
}

}  // namespace

WorkerProcess::WorkerProcess(const WorkerOptions& options) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw failure("no socket for a worker", errno);
    channel_.emplace(ends[0]);
    {
        // Our copy of their end goes before we wait for them, or their death would not show.
        const Channel theirs(ends[1]);
        pid_ = spawn(options, ends[1]);
    }
    std::string message;
    const Channel::Result result = channel_->receive(message, Clock::now() + options.start);
    try {
        if (result != Channel::Result::done)
            throw std::runtime_error(result == Channel::Result::late
                                         ? "a worker was not ready in time"
                                         : "a worker ended before it was ready");
        hello_ = unpackHello(message);
        if (!hello_.fault.empty()) throw std::runtime_error(hello_.fault);
    } catch (...) {
        end();
        throw;
    }
}

WorkerProcess::~WorkerProcess() { end(); }

bool WorkerProcess::alive() {
    if (pid_ <= 0) return false;
    int status = 0;
    if (waitpid(pid_, &status, WNOHANG) != pid_) return true;
    status_ = status;
    pid_ = -1;
    return false;
}

std::optional<int> WorkerProcess::end() {
    if (pid_ > 0) {
        kill(pid_, SIGKILL);
        int status = 0;
        while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
        }
        pid_ = -1;
    }
    return status_;
}

void WorkerProcess::lost(Channel::Result result) {
    if (result == Channel::Result::late) {
        end();
        throw WorkerLost(WorkerLost::Why::late, "a worker was ended at its deadline");
    }
    // The socket closes before the process can be waited for: a moment, or long on a busy machine.
    for (int i = 0; i < 3'000 && alive(); ++i) usleep(1'000);
    const std::optional<int> status = end();
    if (!status) throw WorkerLost(WorkerLost::Why::crash, "a worker closed its socket");
    if (!WIFSIGNALED(*status))
        throw WorkerLost(WorkerLost::Why::crash,
                         "a worker ended with " + std::to_string(WEXITSTATUS(*status)));
    const int number = WTERMSIG(*status);
    throw WorkerLost(
        number == SIGKILL ? WorkerLost::Why::killed : WorkerLost::Why::crash,
        "a worker was ended by signal " + std::to_string(number) + " (" + strsignal(number) + ")");
}

Reply WorkerProcess::call(const std::string& request, std::chrono::milliseconds deadline) {
    if (!alive()) throw WorkerLost(WorkerLost::Why::idle, "a worker was gone");
    const Clock::time_point end = Clock::now() + deadline;
    if (const auto result = channel_->send(request, end); result != Channel::Result::done)
        lost(result);
    std::string message;
    if (const auto result = channel_->receive(message, end); result != Channel::Result::done)
        lost(result);
    try {
        return unpackReply(message);
    } catch (const WireError& nonsense) {
        this->end();
        throw WorkerLost(WorkerLost::Why::crash, nonsense.what());
    }
}

}  // namespace farol::server::worker
