#pragma once

#include <atomic>
#include <condition_variable>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "server/backend.h"
#include "server/log.h"
#include "server/queue.h"
#include "server/worker/nursery.h"
#include "server/worker/quarantine.h"
#include "server/worker/said.h"

namespace farol::server::worker {

struct PoolOptions {
    int workers = 1;
    QueueLimits queue;
    WorkerOptions worker;
    int spares = 1;            ///< processes kept ready to take a lost one's place
    int recycleAfter = 1'000;  ///< jobs a process does before it is replaced
    /// How long a request that met a lost worker waits for the next one.
    std::chrono::milliseconds replacement{1'000};
    std::chrono::seconds quarantine{600};  ///< for a scene that ended two workers
};

/// Does all work in sandboxed processes. One that crashes, hangs or has done its share is
/// replaced; the job it had gets Busy worker.crashed or busy.deadline, no other job notices. One
/// whose worker was killed from outside is begun again, up to three times, then gets Busy
/// worker.killed.
class WorkerPool final : public Backend {
  public:
    /// Starts the workers and waits until one can draw, or has said why it cannot (which goes to
    /// the log and is tried again). `logger` outlives it.
    WorkerPool(PoolOptions options, Logger& logger);
    ~WorkerPool() override;

    Done<render::Picture> render(const render::Job& job, const std::string& tag,
                                 const Turn& turn) override;
    void expectRoom(const std::string& tag, const Turn& turn) const override;
    Done<render::SceneReport> inspect(const render::Job& job) override;
    Done<std::string> mesh(const MeshJob& job) override;
    Done<render::Picture> turntable(const render::Job& job, const Turntable& turn) override;
    Done<render::Picture> notice(const std::string& text,
                                 const render::PictureOptions& options) override;
    Done<scene::Bundle> unpack(const std::string& archive) override;
    Done<GradeReply> grade(const GradeJob& job) override;
    Done<CompareReply> compare(const CompareJob& job) override;
    void check() override;
    BackendState state() const override;
    BackendFacts facts() const override;
    std::string version() const override;

    /// Refuses new jobs (Busy), waits for those being worked on and ends the workers.
    void stop();
    /// The processes there are, for tests.
    std::vector<pid_t> pids() const;

  private:
    struct Slot {
        int index = 0;
        std::unique_ptr<WorkerProcess> process;
        long jobs = 0;  ///< done by this process
    };
    using Queue = JobQueue<Slot>;
    using Shared = std::shared_future<Done<render::Picture>>;

    void run(int index);
    bool ready(Slot& slot, std::chrono::milliseconds patience);
    void drop(Slot& slot, const std::string& reason);
    Done<Reply> ask(std::string packed, const std::string& scene, const Turn& turn = {});
    Reply askSlot(Slot& slot, const std::string& request, const std::string& scene);
    void excuse(Slot& slot, const WorkerLost& lost, const std::string& scene);
    Reply judged(Reply reply) const;
    Done<render::Picture> draw(const render::Job& job, std::string packed, const Turn& turn);
    void admit(const std::string& scene);

    const PoolOptions options_;
    Logger& logger_;
    Said said_;
    Nursery nursery_;
    Queue queue_;
    Quarantine quarantine_;
    mutable std::mutex mutex_;
    std::condition_variable changed_;
    bool anyReady_ = false, anyFailed_ = false, stopping_ = false;
    BackendFacts facts_;
    std::map<std::string, long> restarts_;
    std::map<int, pid_t> pids_;
    std::map<std::string, Shared> inFlight_;
    std::atomic<long> coalesced_{0}, retried_{0};
    std::vector<std::thread> threads_;
};

}  // namespace farol::server::worker
