#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>

#include "server/backend.h"

namespace farol::server {

struct QueueLimits {
    int waiting = 4;                             ///< jobs queued beyond those being worked on
    std::chrono::milliseconds wait{2'000};       ///< for a worker
    std::chrono::milliseconds deadline{10'000};  ///< for the work itself
};

/// A bounded queue of jobs for workers of type Worker. A job that nobody has taken after
/// `limits.wait` is withdrawn; one that is not done after `limits.deadline` is given up (its
/// worker ends it in its own time, the result is dropped).
template <typename Worker>
class JobQueue {
  public:
    explicit JobQueue(QueueLimits limits) : limits_(limits) {}

    /// Blocks until a worker has run `work`. Rethrows what it throws; throws Busy.
    template <typename Result>
    Done<Result> run(std::function<Result(Worker&)> work) {
        const auto ticket = std::make_shared<Ticket>();
        const auto promise = std::make_shared<std::promise<Result>>();
        std::future<Result> future = promise->get_future();
        ticket->work = [promise, work = std::move(work)](Worker& worker) {
            try {
                promise->set_value(work(worker));
            } catch (...) {
                promise->set_exception(std::current_exception());
            }
        };
        const auto start = std::chrono::steady_clock::now();
        {
            std::unique_lock lock(mutex_);
            if (closed_) throw Busy("busy.draining", "The server is shutting down.", 1);
            if (static_cast<int>(queue_.size()) >= limits_.waiting + idle_)
                throw Busy("busy.queue", "All workers are busy and the queue is full.",
                           retryAfterS());
            queue_.push_back(ticket);
            added_.notify_one();
            if (!taken_.wait_for(lock, limits_.wait, [&] { return ticket->taken || closed_; }) ||
                !ticket->taken) {
                std::erase(queue_, ticket);
                throw Busy(closed_ ? "busy.draining" : "busy.queue",
                           "No worker became free in time.", retryAfterS());
            }
        }
        const std::chrono::duration<double, std::milli> waited = ticket->takenAt - start;
        if (future.wait_for(limits_.deadline) != std::future_status::ready)
            throw Busy("busy.deadline", "The work was not done in time.", retryAfterS());
        return {future.get(), waited.count()};
    }

    /// For workers: runs the next job; false when the queue is closed and empty.
    bool workOnce(Worker& worker) {
        std::shared_ptr<Ticket> ticket;
        {
            std::unique_lock lock(mutex_);
            ++idle_;
            added_.wait(lock, [this] { return !queue_.empty() || closed_; });
            --idle_;
            if (queue_.empty()) return false;
            ticket = std::move(queue_.front());
            queue_.pop_front();
            ticket->taken = true;
            ticket->takenAt = std::chrono::steady_clock::now();
            ++busy_;
        }
        taken_.notify_all();
        ticket->work(worker);
        const std::lock_guard lock(mutex_);
        --busy_;
        return true;
    }

    /// No new jobs; those taken are ended, those waiting are refused.
    void close() {
        {
            const std::lock_guard lock(mutex_);
            closed_ = true;
        }
        added_.notify_all();
        taken_.notify_all();
    }

    BackendState state() const {
        const std::lock_guard lock(mutex_);
        return {busy_ + idle_, busy_, static_cast<int>(queue_.size())};
    }

  private:
    struct Ticket {
        std::function<void(Worker&)> work;
        bool taken = false;
        std::chrono::steady_clock::time_point takenAt;
    };

    int retryAfterS() const {
        const auto seconds = std::chrono::ceil<std::chrono::seconds>(limits_.wait).count();
        return static_cast<int>(std::max<long>(1, seconds));
    }

    const QueueLimits limits_;
    mutable std::mutex mutex_;
    std::condition_variable added_, taken_;
    std::deque<std::shared_ptr<Ticket>> queue_;
    int idle_ = 0, busy_ = 0;
    bool closed_ = false;
};

}  // namespace farol::server
