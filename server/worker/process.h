#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <stdexcept>
#include <string>

#include "server/worker/channel.h"
#include "server/worker/messages.h"

namespace farol::server::worker {

/// The worker is gone or had to be ended before it answered.
class WorkerLost : public std::runtime_error {
  public:
    enum class Why {
        late,    ///< the deadline passed
        crash,   ///< a signal of its own making, or it spoke nonsense
        killed,  ///< SIGKILL that was not ours: somebody else's, or the kernel's for memory
        idle     ///< it was gone before the job reached it
    };
    WorkerLost(Why why, const std::string& message) : std::runtime_error(message), why_(why) {}
    Why why() const { return why_; }

  private:
    Why why_;
};

struct WorkerOptions {
    std::string program = "/proc/self/exe";
    std::string scenesDir;                    ///< what workers may read; empty: nothing
    std::size_t memoryBytes = 0;              ///< private memory; 0: no cap
    int said = 2;                             ///< descriptor that they print to
    std::chrono::milliseconds start{30'000};  ///< to be ready to draw
};

/// A worker process seen from the service. The thread that makes it must outlive it: the worker
/// dies with that thread (PR_SET_PDEATHSIG). Used by one thread.
class WorkerProcess {
  public:
    /// Starts it and waits until it can draw. Throws std::runtime_error with the reason.
    explicit WorkerProcess(const WorkerOptions& options);
    /// Ends it at once.
    ~WorkerProcess();
    WorkerProcess(const WorkerProcess&) = delete;
    WorkerProcess& operator=(const WorkerProcess&) = delete;

    /// The reply to a packed request. Throws WorkerLost, and the process has ended then.
    Reply call(const std::string& request, std::chrono::milliseconds deadline);
    /// False when it has ended.
    bool alive();
    pid_t pid() const { return pid_; }
    const Hello& hello() const { return hello_; }

  private:
    [[noreturn]] void lost(Channel::Result result);
    /// Ends it. The status of waitpid if it had ended by itself before, else nothing.
    std::optional<int> end();

    pid_t pid_ = -1;
    std::optional<int> status_;  ///< of its end
    std::optional<Channel> channel_;
    Hello hello_;
};

}  // namespace farol::server::worker
