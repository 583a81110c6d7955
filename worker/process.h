#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>

#include "render/gl_source.h"
#include "scene/files/assets.h"
#include "worker/channel.h"
#include "worker/hello.h"
#include "worker/job.h"

namespace farol::worker {

/// The worker is gone or had to be ended before it answered.
class WorkerLost : public std::runtime_error {
  public:
    enum class Why {
        late,     ///< the deadline passed while it worked, or it waited for itself
        stalled,  ///< the deadline passed while it was stopped or got less than half a core
        cpu,      ///< it used its processor time
        crash,    ///< a signal that it raised, or an exit
        reply,    ///< its reply did not fit the request
        killed,   ///< a signal from outside: another process, or the kernel for lack of memory
        idle      ///< it was gone before the job reached it
    };
    WorkerLost(Why why, const std::string& message) : std::runtime_error(message), why_(why) {}
    Why why() const { return why_; }

  private:
    Why why_;
};

/// Limits of one call.
struct CallLimits {
    std::chrono::milliseconds deadline{0};
    std::chrono::milliseconds cpu{0};  ///< of all threads of the worker
    std::function<bool()> isGone;      ///< RunOptions::isGone; may be empty
};

struct WorkerOptions {
    std::string program = "/proc/self/exe";
    std::string scenesDir;        ///< the folder that workers may read; empty: none
    std::size_t memoryBytes = 0;  ///< private memory; 0: no cap
    render::GlSource gl = render::GlSource::automatic;
    double maxCost = 0.0;  ///< core-seconds of one job (render/plan/cost.h); 0: no bound
    int said = 2;          ///< descriptor that they print to
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

    /// Runs the job. Throws WorkerLost, and the process has ended then.
    Answer call(const PackedJob& job, const CallLimits& limits);
    /// False when it has ended.
    bool alive();
    /// True when another folder is under the path of the scenes: its sandbox knows the old one
    /// only.
    bool isStale() const;
    pid_t pid() const { return pid_; }
    const Hello& hello() const { return hello_; }

  private:
    [[noreturn]] void lost(Channel::Result result, std::chrono::nanoseconds cpuUsed,
                           const CallLimits& limits);
    /// Ends it. The status of waitpid if it had ended by itself before, else nothing.
    std::optional<int> end();

    const std::string scenesDir_;
    const std::optional<scene::FolderIdentity> scenes_;  ///< from before it was started
    pid_t pid_ = -1;
    std::optional<int> status_;  ///< of its end
    std::optional<Channel> channel_;
    Hello hello_;
};

}  // namespace farol::worker
