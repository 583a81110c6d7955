#include "worker/process.h"

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

#include "core/number.h"
#include "worker/process_usage.h"
#include "worker/sandbox.h"
#include "worker/wire.h"

namespace farol::worker {
namespace {

// Variables of Mesa, the loader and the sanitizers. Secrets of the service are not passed on.
bool isPassedOn(std::string_view variable) {
    for (const char* start :
         {"HOME=", "XDG_CACHE_HOME=", "LD_LIBRARY_PATH=", "PATH=", "MESA_", "LP_", "GALLIUM_",
          "GALLIVM_", "ASAN_OPTIONS=", "UBSAN_OPTIONS=", "LSAN_OPTIONS=", "TSAN_OPTIONS="})
        if (variable.substr(0, std::strlen(start)) == start) return true;
    return false;
}

constexpr std::uint64_t kMaxHello = std::uint64_t{1} << 20U;

std::runtime_error failure(const char* what, int error) {
    return std::runtime_error(std::string(what) + ": " + std::strerror(error));
}

/// True for the signals by which a fault of the program itself ends it.
bool isRaisedByFaults(int number) {
    for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS, SIGTRAP})
        if (number == fault) return true;
    return false;
}

/// Starts a worker by posix_spawn, which works as vfork: inherits no lock of another thread, and
/// loads the program again.
pid_t spawn(const WorkerOptions& options, int socket) {
    std::vector<std::string> words = {"farol",    "worker",
                                      "--memory", std::to_string(options.memoryBytes),
                                      "--gl",     std::string(render::kGlSourceWords[options.gl])};
    if (options.maxCost > 0.0)
        words.insert(words.end(), {"--max-cost", formatNumber(options.maxCost)});
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

WorkerProcess::WorkerProcess(const WorkerOptions& options)
    : scenesDir_(options.scenesDir),
      scenes_(scenesDir_.empty() ? std::nullopt : scene::folderIdentity(scenesDir_)) {
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
    const Channel::Result result =
        channel_->receive(message, Clock::now() + options.start, kMaxHello);
    try {
        if (result != Channel::Result::done)
            throw std::runtime_error(result == Channel::Result::late
                                         ? "a worker was not ready in time"
                                         : "a worker ended before it was ready");
        hello_ = unpack<Hello>(message);
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

bool WorkerProcess::isStale() const {
    if (scenesDir_.empty()) return false;
    // One that is away may come back as it was.
    const auto now = scene::folderIdentity(scenesDir_);
    return now && now != scenes_;
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

void WorkerProcess::lost(Channel::Result result, std::chrono::nanoseconds cpuUsed,
                         const CallLimits& limits) {
    using Why = WorkerLost::Why;
    switch (result) {
        case Channel::Result::late: {
            // A request that got less than half a core was held up by the machine, not by its
            // work; one whose threads all wait for each other hangs by itself.
            const Activity activity = activityOf(pid_);
            const bool isStarved = cpuUsed < limits.deadline / 2;
            end();
            if (activity == Activity::stopped)
                throw WorkerLost(Why::stalled, "a worker was stopped until its deadline");
            if (activity == Activity::runnable && isStarved)
                throw WorkerLost(Why::stalled, "a worker got too little processor time");
            throw WorkerLost(Why::late, "a worker was ended at its deadline");
        }
        case Channel::Result::interrupted:
            end();
            throw WorkerLost(Why::cpu, "a worker was ended for its processor time");
        case Channel::Result::oversize:
            end();
            throw WorkerLost(Why::reply, "a worker's reply is longer than the request allows");
        case Channel::Result::done:
        case Channel::Result::closed:
            break;
    }
    // The socket closes before the process can be waited for: a moment, or long on a busy machine.
    for (int i = 0; i < 3'000 && alive(); ++i) usleep(1'000);
    const std::optional<int> status = end();
    if (!status) throw WorkerLost(Why::crash, "a worker closed its socket");
    if (!WIFSIGNALED(*status))
        throw WorkerLost(Why::crash, "a worker ended with " + std::to_string(WEXITSTATUS(*status)));
    const int number = WTERMSIG(*status);
    throw WorkerLost(
        isRaisedByFaults(number) ? Why::crash : Why::killed,
        "a worker was ended by signal " + std::to_string(number) + " (" + strsignal(number) + ")");
}

Answer WorkerProcess::call(const PackedJob& job, const CallLimits& limits) {
    if (!alive()) throw WorkerLost(WorkerLost::Why::idle, "a worker was gone");
    const Clock::time_point end = Clock::now() + limits.deadline;
    const std::chrono::nanoseconds before = cpuTimeOf(pid_);
    const auto cpuUsed = [&] { return cpuTimeOf(pid_) - before; };
    Channel::Result result = channel_->send(job.bytes, end);
    std::string message;
    bool isCancelled = false;
    const auto watch = [&] {
        if (!isCancelled && limits.isGone && limits.isGone()) {
            isCancelled = true;
            channel_->send("", end);  // a worker that is gone shows when its answer is read
        }
        return cpuUsed() > limits.cpu;
    };
    try {
        if (result == Channel::Result::done)
            result = channel_->receive(message, end, job.limits.bytes, watch);
    } catch (...) {
        this->end();  // the rest of the reply would be read as the next one
        throw;
    }
    if (result != Channel::Result::done) lost(result, cpuUsed(), limits);
    try {
        return readAnswer(message, job);
    } catch (const WireError& misfit) {
        this->end();
        throw WorkerLost(WorkerLost::Why::reply, misfit.what());
    }
}

}  // namespace farol::worker
