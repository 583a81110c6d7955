#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "worker/backend.h"
#include "worker/event_log.h"
#include "worker/quarantine.h"
#include "worker/queue.h"
#include "worker/worker_output.h"
#include "worker/worker_spawner.h"

namespace farol::worker {

struct PoolOptions {
    int workers = 1;
    QueueLimits queue;
    WorkerOptions worker;
    int spares = 1;  ///< processes kept ready to replace lost ones
    /// Ends a process after each job with data that a client sent; keeps at least as many spares
    /// as workers.
    bool isolatesUploads = false;
    int recycleAfter = 1'000;  ///< jobs a process does before it is replaced
    /// Processor time of a worker for one request; 0: twice the deadline, as two cores have.
    std::chrono::milliseconds cpu{0};
    std::chrono::seconds quarantine{600};  ///< of requests, and of scenes, that end workers
};

/// Runs all jobs in sandboxed processes. Replaces a process that crashes, hangs or has done
/// recycleAfter jobs; its job gets Busy worker.crashed, worker.reply or busy.deadline, or Error
/// limit.cpu, and no other job is affected. A job whose worker was killed from outside is run up to
/// three times, then gets Busy worker.killed.
class WorkerPool final : public Backend {
  public:
    /// Starts the workers and waits until one can render or one has failed to start. Failures are
    /// logged and retried. `log` is called until the pool is destroyed.
    WorkerPool(PoolOptions options, EventLog log);
    ~WorkerPool() override;

    void expectRoom(const RunOptions& options) const override;
    BackendState state() const override;
    BackendFacts facts() const override;
    std::string version() const override;

    /// Refuses new jobs (Busy), waits for running jobs and ends the workers.
    void stop();

  protected:
    Done<std::any> submit(PackedJob job, const RunOptions& options) override;

  private:
    struct Slot {
        std::unique_ptr<WorkerProcess> process;
        long jobs = 0;                            ///< done by this process
        bool isSpent = false;                     ///< by an upload's job, when those are isolated
        std::chrono::nanoseconds cpuWhenIdle{0};  ///< processor time when it was ready for a job
    };
    using Queue = JobQueue<Slot>;
    using Shared = std::shared_future<Done<std::any>>;

    void serveSlot(int index);
    bool ready(Slot& slot, std::chrono::milliseconds patience);
    void drop(Slot& slot, const std::string& reason);
    /// Runs the job on a worker and judges its answer.
    Done<std::any> ask(PackedJob job, const RunOptions& options);
    Answer askSlot(Slot& slot, const PackedJob& job, const std::function<bool()>& isGone);
    void excuse(Slot& slot, const WorkerLost& lost, const JobIdentity& identity);
    /// Throws the exception of an answer that is not `done`.
    void judge(Answer& answer) const;
    Done<std::any> askCounted(PackedJob job, const RunOptions& options);
    void admit(const JobIdentity& identity);

    const PoolOptions options_;
    EventLog log_;
    WorkerOutput output_;
    WorkerSpawner spawner_;
    Queue queue_;
    Quarantine quarantine_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    bool anyReady_ = false, anyFailed_ = false, stopping_ = false;
    BackendFacts facts_;
    std::map<std::string, long> restarts_;
    std::map<std::string, JobCounts> jobs_;
    int ready_ = 0;  ///< slots with a process
    std::map<std::string, Shared> inFlight_;
    std::atomic<long> coalesced_{0}, retried_{0};
    const std::string version_;
    std::vector<std::thread> threads_;
};

}  // namespace farol::worker
