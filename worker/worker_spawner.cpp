#include "worker/worker_spawner.h"

#include <algorithm>

namespace farol::worker {
namespace {

constexpr std::chrono::milliseconds kFirstPause{10}, kMaxPause{5'000};

}  // namespace

WorkerSpawner::WorkerSpawner(Options options, Report report)
    : options_(std::move(options)), report_(std::move(report)) {}

WorkerSpawner::~WorkerSpawner() {
    stop();
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    wanted_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void WorkerSpawner::begin(int workers) {
    {
        const std::lock_guard lock(mutex_);
        expected_ = workers;
    }
    for (int i = 0; i < options_.starters; ++i) threads_.emplace_back([this] { run(); });
}

void WorkerSpawner::stop() {
    std::deque<std::unique_ptr<WorkerProcess>> left;
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
        left.swap(processes_);
    }
    wanted_.notify_all();
    ready_.notify_all();
}

// The caller holds the lock.
bool WorkerSpawner::isWanted() const {
    const int wanted = std::max(expected_, waiting_) + options_.spares;
    return !stopping_ && static_cast<int>(processes_.size()) + starting_ < wanted;
}

void WorkerSpawner::run() {
    std::chrono::milliseconds pause{0};
    std::unique_lock lock(mutex_);
    for (;;) {
        wanted_.wait(lock, [this] { return ended_ || isWanted(); });
        if (ended_) return;
        ++starting_;
        lock.unlock();
        std::unique_ptr<WorkerProcess> process;
        try {
            process = std::make_unique<WorkerProcess>(options_.worker);
            pause = std::chrono::milliseconds(0);
        } catch (const std::exception& fault) {
            pause = std::clamp(pause * 2, kFirstPause, kMaxPause);
            report_(fault.what());
        }
        lock.lock();
        --starting_;
        if (process && !stopping_) {
            processes_.push_back(std::move(process));
            ready_.notify_one();
        } else if (!process) {
            wanted_.wait_for(lock, pause, [this] { return ended_; });
        }
    }
}

std::unique_ptr<WorkerProcess> WorkerSpawner::take(std::chrono::milliseconds patience) {
    std::unique_lock lock(mutex_);
    const auto end = std::chrono::steady_clock::now() + patience;
    ++waiting_;
    std::unique_ptr<WorkerProcess> process;
    for (;;) {
        wanted_.notify_all();
        ready_.wait_until(lock, end, [this] { return stopping_ || !processes_.empty(); });
        if (stopping_ || processes_.empty()) break;
        process = std::move(processes_.front());
        processes_.pop_front();
        if (process->alive() && !process->isStale()) break;  // else it is unusable
        process.reset();
    }
    --waiting_;
    if (process) expected_ = std::max(0, expected_ - 1);
    lock.unlock();
    wanted_.notify_all();
    return process;
}

}  // namespace farol::worker
