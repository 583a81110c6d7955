#pragma once

#include <any>
#include <cstdint>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/error.h"
#include "worker/hello.h"
#include "worker/job.h"

/// Interface through which jobs are submitted. A job is a plain function of bytes and options, so
/// the implementation may use threads, processes or another machine.
namespace farol::worker {

/// The work was refused or not done for a reason outside the request; the client may try again.
class Busy : public std::runtime_error {
  public:
    /// `message` has a code busy.*, worker.*, store.*, limit.client, limit.rate or not-ready.
    Busy(Message message, int retryAfterS)
        : std::runtime_error(message.text),
          diagnostic_(diagnosticOf(Severity::error, std::move(message))),
          retryAfterS_(retryAfterS) {}
    const Diagnostic& diagnostic() const { return diagnostic_; }
    const std::string& code() const { return diagnostic_.code; }
    int retryAfterS() const { return retryAfterS_; }

  private:
    Diagnostic diagnostic_;
    int retryAfterS_;
};

/// The frame number of an image in a session of an orbiting client: older frames are dropped.
struct Turn {
    std::string session;   ///< chosen by the client; empty: not one of a session
    std::int64_t seq = 0;  ///< grows from frame to frame
};

template <typename Result>
struct Done {
    Result result;
    double queueMs = 0;  ///< time waited for a worker
};

/// How the service wants a job to be done.
struct RunOptions {
    /// Of a shared task: a job that comes while one of the same tag (the picture's entity tag) runs
    /// shares its reply. Empty: jobs of the same bytes do; the files of a folder are not among
    /// them.
    std::string tag;
    Turn turn;
    /// Whether nobody waits for the reply any more. Where it is given, it is asked every
    /// Channel::kLook from the thread of a worker until run() ends, and once it is true, tasks that
    /// look at WorkerState::isCancelled end early: Busy busy.cancelled.
    std::function<bool()> isGone = {};
};

/// The jobs of one kind since the start.
struct JobCounts {
    long done = 0, refused = 0;  ///< refused: the caller's fault
    long failed = 0;             ///< for any other reason, before or after a worker took it
    double seconds = 0.0;        ///< in workers, of those that are done
};

/// Where a backend stands, for readiness and metrics.
struct BackendState {
    int workers = 0, busy = 0, queued = 0;
    std::map<std::string, long> restarts;  ///< of workers, by reason, since the start
    long coalesced = 0;                    ///< pictures answered by one being drawn already
    long retried = 0;                      ///< jobs begun again: their worker was killed
    long superseded = 0;                   ///< frames that a newer one of their session overtook
    std::map<std::string, JobCounts> jobs = {};  ///< by the task's name
};

/// The renderer and its sandbox.
struct BackendFacts {
    std::string gl;
    Layers sandbox;  ///< layer -> "on" and the like, or "missing: why"
};

/// All calls block until done, may come from many threads at once, and throw farol::Error for the
/// caller's fault and Busy when over capacity; anything else is a fault of ours.
class Backend {
  public:
    virtual ~Backend() = default;
    /// Runs one job. Busy busy.superseded where a newer frame of the same session is known before
    /// this one is begun.
    template <Task T>
    Done<typename T::Reply> run(const typename T::Request& request,
                                const RunOptions& options = {}) {
        Done<std::any> done = submit(packJob<T>(request), options);
        return {std::any_cast<typename T::Reply>(std::move(done.result)), done.queueMs};
    }
    /// Throws Busy where run() with these would be refused now for want of room.
    virtual void expectRoom(const RunOptions& options) const = 0;
    virtual BackendState state() const = 0;
    virtual BackendFacts facts() const { return {}; }
    /// The renderer's version, for /version and ETags.
    virtual std::string version() const = 0;

  protected:
    /// The reply is one that the job's readReply() made.
    virtual Done<std::any> submit(PackedJob job, const RunOptions& options) = 0;
};

}  // namespace farol::worker
