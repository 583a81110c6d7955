#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>

#include "server/backend.h"

namespace farol::server {

struct QueueLimits {
    int waiting = 4;                             ///< jobs queued beyond those being worked on
    std::chrono::milliseconds wait{2'000};       ///< for a worker
    std::chrono::milliseconds deadline{10'000};  ///< for the work itself
};

/// A bounded queue of jobs for workers of type Worker. A job that nobody has taken after
/// `limits.wait` is withdrawn; one that is not done after `limits.deadline` is given up (its
/// worker ends it in its own time, the result is dropped). A job goes to the free worker whose
/// last job had the same key (it has the scene warm), else to the one that is free the longest.
template <typename Worker>
class JobQueue {
    struct Ticket {
        std::function<void(Worker&)> work;
        std::string key;
        bool taken = false;
        std::chrono::steady_clock::time_point takenAt;
    };

  public:
    /// Where one worker waits for its jobs.
    class Seat {
        friend class JobQueue;
        std::shared_ptr<Ticket> ticket;  ///< handed over, not begun
        std::condition_variable called;
        std::string warmFor;
    };

    explicit JobQueue(QueueLimits limits) : limits_(limits) {}

    /// Blocks until a worker has run `work`. Rethrows what it throws; throws Busy. `key` names
    /// what a worker is warm for.
    template <typename Result>
    Done<Result> run(std::function<Result(Worker&)> work, std::string key = "") {
        const auto ticket = std::make_shared<Ticket>();
        ticket->key = std::move(key);
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
            if (Seat* seat = seatFor(ticket->key)) {
                seat->ticket = ticket;
                take(*ticket);
                seat->called.notify_one();
            } else if (static_cast<int>(queue_.size()) >= limits_.waiting) {
                throw Busy("busy.queue", "All workers are busy and the queue is full.",
                           retryAfterS());
            } else {
                queue_.push_back(ticket);
            }
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

    /// For workers: waits for the next job and runs it; false when the queue is closed and empty.
    /// After `patience` without a job it returns true all the same, so that the worker may look
    /// after itself.
    bool workOnce(Worker& worker, Seat& seat,
                  std::chrono::milliseconds patience = std::chrono::milliseconds::max()) {
        std::shared_ptr<Ticket> ticket;
        {
            std::unique_lock lock(mutex_);
            if (!queue_.empty()) {
                ticket = std::move(queue_.front());
                queue_.pop_front();
                take(*ticket);
            } else {
                const auto called = [&] { return seat.ticket || closed_; };
                idle_.push_back(&seat);
                if (patience == std::chrono::milliseconds::max())
                    seat.called.wait(lock, called);
                else
                    seat.called.wait_for(lock, patience, called);
                std::erase(idle_, &seat);
                if (!seat.ticket) return !closed_;
                ticket = std::move(seat.ticket);
                seat.ticket = nullptr;
            }
            seat.warmFor = ticket->key;
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
            for (Seat* seat : idle_) seat->called.notify_one();
        }
        taken_.notify_all();
    }

    BackendState state() const {
        const std::lock_guard lock(mutex_);
        BackendState state;
        state.busy = busy_;
        state.workers = busy_ + static_cast<int>(idle_.size());
        state.queued = static_cast<int>(queue_.size());
        return state;
    }

  private:
    // The callers hold the lock.
    void take(Ticket& ticket) {
        ticket.taken = true;
        ticket.takenAt = std::chrono::steady_clock::now();
        ++busy_;
    }

    Seat* seatFor(const std::string& key) {
        if (idle_.empty()) return nullptr;
        const auto warm = std::find_if(idle_.begin(), idle_.end(),
                                       [&](const Seat* seat) { return seat->warmFor == key; });
        const auto chosen = warm == idle_.end() ? idle_.begin() : warm;
        Seat* seat = *chosen;
        idle_.erase(chosen);
        return seat;
    }

    int retryAfterS() const {
        const auto seconds = std::chrono::ceil<std::chrono::seconds>(limits_.wait).count();
        return static_cast<int>(std::max<long>(1, seconds));
    }

    const QueueLimits limits_;
    mutable std::mutex mutex_;
    std::condition_variable taken_;
    std::deque<std::shared_ptr<Ticket>> queue_;
    std::deque<Seat*> idle_;  ///< longest free first
    int busy_ = 0;
    bool closed_ = false;
};

}  // namespace farol::server
