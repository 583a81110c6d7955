#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "worker/process.h"

namespace farol::worker {

/// Starts worker processes ahead of need, so that a lost or retired one is replaced at once by
/// one that is initialised.
class WorkerSpawner {
  public:
    struct Options {
        WorkerOptions worker;
        int starters = 1;  ///< processes started side by side, 1 or more
        int spares = 1;    ///< kept ready in addition to the processes that are waited for
    };
    /// Called for each start that failed, by several threads.
    using Report = std::function<void(const std::string& fault)>;

    /// Starts nothing yet: begin() does so.
    WorkerSpawner(Options options, Report report);
    ~WorkerSpawner();
    WorkerSpawner(const WorkerSpawner&) = delete;
    WorkerSpawner& operator=(const WorkerSpawner&) = delete;

    /// Starts the first processes, for `workers` calls of take().
    void begin(int workers);
    /// Returns an initialised process; waits for one until `patience` is over, then null. Null at
    /// once after stop().
    std::unique_ptr<WorkerProcess> take(std::chrono::milliseconds patience);
    /// Starts no more and ends the processes not taken yet. The starter threads stay until the
    /// destructor, because a worker dies with the thread that started it.
    void stop();

  private:
    void run();
    bool isWanted() const;

    const Options options_;
    const Report report_;
    std::mutex mutex_;
    std::condition_variable wanted_, ready_;
    std::deque<std::unique_ptr<WorkerProcess>> processes_;  ///< ready, oldest first
    int starting_ = 0, waiting_ = 0, expected_ = 0;
    bool stopping_ = false, ended_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace farol::worker
