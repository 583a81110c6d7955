#include "cli/confine.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <numeric>
#include <optional>

#include "cli/command.h"
#include "cli/files.h"
#include "cli/messages.h"
#include "worker/sandbox.h"

namespace farol::cli {
namespace {

using worker::kSocket;

constexpr int kMaxFrame = 3'600;
constexpr std::uint64_t kMaxOutputBytes = std::uint64_t{16} << 30U;
constexpr std::uint32_t kMaxFaultBytes = 8'192;

/// Signals by which users and shells end programs.
constexpr std::array kRequests{SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGQUIT};

int exitStatus = kInternal;  ///< of the child, for its handler of the exit

/// Precedes the bytes of an output.
struct Head {
    std::uint32_t output = 0;
    std::int32_t frame = kNoFrame;
    std::uint64_t size = 0;
};

/// Closes the descriptor at the end.
struct Socket {
    int fd = -1;
    Socket() = default;
    Socket(const Socket&) = delete;
    Socket& operator=(const Socket&) = delete;
    ~Socket() { reset(); }
    void reset() {
        if (fd >= 0) ::close(fd);
        fd = -1;
    }
};

void makePair(Socket& ours, Socket& theirs) {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
        throw std::runtime_error(std::string("no socket for a process: ") + std::strerror(errno));
    ours.fd = ends[0];
    theirs.fd = ends[1];
}

/// fork(). Throws std::runtime_error with the reason.
pid_t startProcess() {
    const pid_t process = fork();
    if (process < 0)
        throw std::runtime_error(std::string("cannot start a process: ") + std::strerror(errno));
    return process;
}

bool sendAll(int socket, const void* data, std::size_t size) {
    const char* from = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t sent = ::send(socket, from, size, MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0) return false;
        from += sent;
        size -= static_cast<std::size_t>(sent);
    }
    return true;
}

bool receiveAll(int socket, void* data, std::size_t size) {
    char* to = static_cast<char*>(data);
    while (size > 0) {
        const ssize_t got = ::recv(socket, to, size, 0);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return false;
        to += got;
        size -= static_cast<std::size_t>(got);
    }
    return true;
}

/// The child's side: the parent writes.
class SentOutputs final : public Outputs {
  public:
    SentOutputs(worker::Layers layers, std::vector<int> helpers)
        : layers_(std::move(layers)), helpers_(std::move(helpers)) {}

    void write(std::size_t output, std::string_view bytes, int frame) override {
        const Head head{static_cast<std::uint32_t>(output), frame, bytes.size()};
        std::uint32_t size = 0;
        if (!sendAll(kSocket, &head, sizeof head) ||
            !sendAll(kSocket, bytes.data(), bytes.size()) ||
            !receiveAll(kSocket, &size, sizeof size))
            throw OutputError(message<"output.unwritable/parent">());
        std::string fault(std::min(size, kMaxFaultBytes), '\0');
        if (!receiveAll(kSocket, fault.data(), fault.size()))
            throw OutputError(message<"output.unwritable/parent">());
        if (!fault.empty())
            throw OutputError(message<"output.unwritable/reason">("reason"_arg = uncut(fault)));
    }
    const worker::Layers& layers() const override { return layers_; }
    const std::vector<int>& helpers() const override { return helpers_; }

  private:
    worker::Layers layers_;
    std::vector<int> helpers_;
};

/// Writes them itself: the sandbox is off.
class OwnOutputs final : public Outputs {
  public:
    explicit OwnOutputs(const Confinement& confinement) : confinement_(confinement) {}
    void write(std::size_t output, std::string_view bytes, int frame) override {
        writeOutput(framePath(confinement_.outputs.at(output), frame), bytes);
    }
    const worker::Layers& layers() const override { return layers_; }
    const std::vector<int>& helpers() const override { return helpers_; }

  private:
    const Confinement& confinement_;
    const worker::Layers layers_;
    const std::vector<int> helpers_;
};

/// Keeps the signals by which users end programs for later: a file is written whole or not begun.
class SignalsHeld {
  public:
    SignalsHeld() {
        sigset_t requests;
        sigemptyset(&requests);
        for (const int one : kRequests) sigaddset(&requests, one);
        sigprocmask(SIG_BLOCK, &requests, &before_);
    }
    ~SignalsHeld() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
    SignalsHeld(const SignalsHeld&) = delete;
    SignalsHeld& operator=(const SignalsHeld&) = delete;

  private:
    sigset_t before_{};
};

/// Whether the output is a file that is written whole: nobody may be reading a pipe.
bool isPlainFile(const std::string& path) {
    std::error_code unknown;
    const auto status = std::filesystem::status(path, unknown);
    return path != "-" &&
           (!std::filesystem::exists(status) || std::filesystem::is_regular_file(status));
}

/// Receives one output and writes it. Returns the reason of a failure, empty for none; nothing
/// where the child ended before all of it arrived.
std::optional<std::string> receiveOutput(int socket, const std::string& path, std::uint64_t size) {
    std::array<char, 256 << 10> chunk;
    std::optional<SignalsHeld> held;
    if (isPlainFile(path)) held.emplace();
    std::string fault;
    std::unique_ptr<OutputFile> file;
    const auto attempt = [&fault](const auto& step) {
        if (!fault.empty()) return;
        try {
            step();
        } catch (const OutputError& error) {
            fault = error.what();
        }
    };
    attempt([&] { file = std::make_unique<OutputFile>(path); });
    while (size > 0) {
        const std::size_t part = std::min<std::uint64_t>(size, chunk.size());
        if (!receiveAll(socket, chunk.data(), part)) return std::nullopt;
        attempt([&] { file->append({chunk.data(), part}); });
        size -= part;
    }
    attempt([&] { file->commit(); });
    return fault;
}

struct Received {
    bool isValid = true;    ///< the child kept to its outputs
    std::size_t files = 0;  ///< written
};

/// Writes the outputs that the child sends until it ends.
Received writeOutputs(int socket, const Confinement& confinement) {
    Received received;
    Head head;
    while (receiveAll(socket, &head, sizeof head)) {
        if (head.output >= confinement.outputs.size() || head.frame < kNoFrame ||
            head.frame > kMaxFrame || head.size > kMaxOutputBytes) {
            received.isValid = false;
            return received;
        }
        const std::string path = framePath(confinement.outputs[head.output], head.frame);
        std::optional<std::string> fault = receiveOutput(socket, path, head.size);
        if (!fault) return received;
        if (fault->empty()) ++received.files;
        fault->resize(std::min<std::size_t>(fault->size(), kMaxFaultBytes));
        const auto size = static_cast<std::uint32_t>(fault->size());
        if (!sendAll(socket, &size, sizeof size) || !sendAll(socket, fault->data(), size))
            return received;
    }
    return received;
}

/// Begins a process of this program that ends with its parent: `sockets` are kSocket and the
/// descriptors after it, all other inherited ones belong to the parent.
void beginChild(pid_t parent, std::vector<int> sockets) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(kInternal);  // it ended before that
    // Mesa and others print to 1 and 2.
    const int count = static_cast<int>(sockets.size());
    for (int& one : sockets) one = fcntl(one, F_DUPFD, kSocket + count);
    for (int i = 0; i < count; ++i) dup2(sockets[static_cast<std::size_t>(i)], kSocket + i);
    closefrom(kSocket + count);
    // Handlers run in the reverse order: Mesa's, which writes the rest of its shader cache, then
    // this one, and none that libraries registered before. Those would copy pages that are shared
    // with the parent, and a sanitizer's would stop all threads by calls that are refused here.
    std::atexit([] { _exit(exitStatus); });
}

worker::Layers closeIn(const Confinement& confinement) {
    worker::SandboxOptions options;
    options.readable = confinement.readable;
    options.memoryBytes = confinement.flags.memoryMiB << 20U;
    return worker::closeCommandLine(options);
}

/// Ends the process with the exit code of the work.
[[noreturn]] void runChild(const Confinement& confinement, Report& report,
                           const ConfinedWork& work) {
    exitStatus = runGuarded(
        [&] {
            std::vector<int> helpers(static_cast<std::size_t>(confinement.helpers));
            std::iota(helpers.begin(), helpers.end(), kSocket + 1);
            SentOutputs outputs(closeIn(confinement), std::move(helpers));
            try {
                return work(outputs);
            } catch (const std::bad_alloc&) {
                throw Error(
                    message<"limit.memory/command">("max"_arg = confinement.flags.memoryMiB));
            }
        },
        report);
    report.finish(exitStatus);
    std::cout.flush();
    std::exit(exitStatus);
}

/// Ends the process.
[[noreturn]] void runHelper(const Confinement& confinement, const HelperWork& help, int index) {
    exitStatus = kInternal;
    try {
        closeIn(confinement);
        help(index, kSocket);
        exitStatus = kDone;
    } catch (const std::exception&) {
        // The child does this work, too, and reports the same fault.
    }
    std::exit(exitStatus);
}

bool isRequest(int signal) {
    return std::find(kRequests.begin(), kRequests.end(), signal) != kRequests.end();
}

/// The helpers of a child, as the parent sees them. Ends them with it.
class Helpers {
  public:
    Helpers() = default;
    ~Helpers() {
        for (const pid_t one : processes_) kill(one, SIGKILL);
        for (const pid_t one : processes_)
            while (waitpid(one, nullptr, 0) < 0 && errno == EINTR) {
            }
    }
    Helpers(const Helpers&) = delete;
    Helpers& operator=(const Helpers&) = delete;

    /// Begins helper number `index`.
    void add(const Confinement& confinement, const HelperWork& help, int index, pid_t parent) {
        auto ours = std::make_unique<Socket>();
        Socket theirs;
        makePair(*ours, theirs);
        const pid_t process = startProcess();
        if (process == 0) {
            beginChild(parent, {theirs.fd});
            runHelper(confinement, help, index);
        }
        processes_.push_back(process);
        sockets_.push_back(std::move(ours));
    }
    /// The descriptors that the child reads by.
    std::vector<int> descriptors() const {
        std::vector<int> all;
        for (const auto& one : sockets_) all.push_back(one->fd);
        return all;
    }
    /// Leaves them to the child.
    void closeSockets() { sockets_.clear(); }

  private:
    std::vector<pid_t> processes_;
    std::vector<std::unique_ptr<Socket>> sockets_;
};

/// Ends this process as the child ended, or returns the exit code for its crash.
int reportEnd(Report& report, int status, std::size_t files) {
    if (WIFEXITED(status)) _exit(WEXITSTATUS(status));  // nothing was written here
    const int number = WTERMSIG(status);
    if (isRequest(number)) {
        ::signal(number, SIG_DFL);
        ::raise(number);
    }
    const std::string name = "signal " + std::to_string(number) + " (" + strsignal(number) + ")";
    if (number == SIGKILL)
        report.fail(message<"worker.killed/command">("signal"_arg = name, "written"_arg = files));
    else
        report.fail(message<"worker.crashed/command">("signal"_arg = name, "written"_arg = files));
    return kInternal;
}

}  // namespace

void addConfinement(CLI::App& command, ConfinementFlags& flags) {
    command
        .add_flag("--no-sandbox", flags.isOff,
                  "reads the files in this process, with all its rights")
        ->envname("FAROL_NO_SANDBOX")
        ->group("Sandbox");
    takesNumber(command.add_option("--worker-memory", flags.memoryMiB,
                                   "memory of the process that reads the files, MiB; 0: no cap"),
                0, 1 << 20);
    command.get_option("--worker-memory")->group("Sandbox");
}

int confine(const Confinement& confinement, Report& report, const ConfinedWork& work,
            const HelperWork& help) {
    if (confinement.flags.isOff) {
        OwnOutputs outputs(confinement);
        return work(outputs);
    }
    std::cout.flush();
    std::cerr.flush();
    const pid_t parent = getpid();
    std::optional<Helpers> helpers(std::in_place);
    for (int i = 0; i < confinement.helpers; ++i) helpers->add(confinement, help, i, parent);
    Socket ours, theirs;
    makePair(ours, theirs);
    const pid_t child = startProcess();
    if (child == 0) {
        std::vector<int> sockets = helpers->descriptors();
        sockets.insert(sockets.begin(), theirs.fd);
        beginChild(parent, std::move(sockets));
        runChild(confinement, report, work);
    }
    theirs.reset();
    helpers->closeSockets();
    const Received received = writeOutputs(ours.fd, confinement);
    if (!received.isValid) kill(child, SIGKILL);
    ours.reset();
    int status = 0;
    while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR)
            throw std::runtime_error(std::string("cannot wait for a process: ") +
                                     std::strerror(errno));
    helpers.reset();  // reportEnd() ends the process
    if (received.isValid) return reportEnd(report, status, received.files);
    report.fail(message<"worker.crashed/output">());
    return kInternal;
}

std::string framePath(const std::string& path, int frame) {
    if (frame == kNoFrame) return path;
    const std::size_t percent = path.find('%');
    if (percent == std::string::npos) return path;
    std::size_t at = percent + 1, width = 0;
    while (at < path.size() && path[at] >= '0' && path[at] <= '9')
        width = std::min<std::size_t>(width * 10 + static_cast<std::size_t>(path[at++] - '0'), 20);
    if (at >= path.size() || path[at] != 'd') return path;
    std::string digits = std::to_string(frame);
    if (digits.size() < width) digits.insert(0, width - digits.size(), '0');
    return path.substr(0, percent) + digits + path.substr(at + 1);
}

}  // namespace farol::cli
