#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <string>

#include "core/lru_cache.h"
#include "worker/backend.h"
#include "worker/messages.h"

namespace farol::worker {

constexpr std::size_t kMaxSessions = 4'096;  ///< that are remembered

constexpr double kMemory = 0.1;  ///< weight of the last job in their mean time

struct QueueLimits {
    int waiting = 4;                             ///< jobs queued beyond those being worked on
    std::chrono::milliseconds wait{2'000};       ///< for a worker
    std::chrono::milliseconds deadline{10'000};  ///< for the work itself
};

/// A bounded queue of jobs for workers of type Worker. A job that no worker has taken after
/// `limits.wait` is withdrawn; one that is not done after `limits.deadline` is abandoned (its
/// worker finishes it, the result is dropped). A job goes to the idle worker whose last job had
/// the same key (it has the scene cached), else to the one that is idle the longest.
/// Of the jobs of one session only the newest waits: it replaces the older ones.
template <typename Worker>
class JobQueue {
    struct Ticket {
        std::function<void(Worker&)> work;
        std::string key;
        Turn turn;
        bool taken = false, superseded = false;
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

    /// Throws the Busy that run() would throw now for want of room: before work is done for a job
    /// that will be refused.
    void expectRoom(const Turn& turn) const {
        const std::lock_guard lock(mutex_);
        if (!idle_.empty() || static_cast<int>(queue_.size()) < limits_.waiting) return;
        const auto overtaken = [&](const std::shared_ptr<Ticket>& one) {
            return one->turn.session == turn.session && one->turn.seq < turn.seq;
        };
        if (!turn.session.empty() && std::any_of(queue_.begin(), queue_.end(), overtaken)) return;
        throw full();
    }

    /// Blocks until a worker has run `work`. Propagates its exceptions; throws Busy. `key` names
    /// the scene: prefers an idle worker whose last job had the same.
    template <typename Result>
    Done<Result> run(std::function<Result(Worker&)> work, std::string key = "", Turn turn = {}) {
        const auto ticket = std::make_shared<Ticket>();
        ticket->key = std::move(key);
        ticket->turn = std::move(turn);
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
            if (closed_) throw Busy(message<"busy.draining">(), 1);
            supersede(ticket->turn);
            if (Seat* seat = seatFor(ticket->key)) {
                seat->ticket = ticket;
                take(*ticket);
                seat->called.notify_one();
            } else if (static_cast<int>(queue_.size()) >= limits_.waiting) {
                throw full();
            } else {
                queue_.push_back(ticket);
            }
            taken_.wait_for(lock, limits_.wait,
                            [&] { return ticket->taken || ticket->superseded || closed_; });
            if (ticket->superseded) throw superseded();
            if (!ticket->taken) {
                std::erase(queue_, ticket);
                throw Busy(closed_ ? message<"busy.draining">() : message<"busy.queue/wait">(),
                           retryAfterS());
            }
        }
        const std::chrono::duration<double, std::milli> waited = ticket->takenAt - start;
        if (future.wait_for(limits_.deadline) != std::future_status::ready)
            throw Busy(message<"busy.deadline">(), 1);
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
        const auto begun = std::chrono::steady_clock::now();
        ticket->work(worker);
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
        const std::lock_guard lock(mutex_);
        --busy_;
        meanS_ += kMemory * (took.count() - meanS_);
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
        state.superseded = superseded_;
        return state;
    }

  private:
    // The callers hold the lock.
    Busy full() const { return {message<"busy.queue">(), retryAfterS()}; }

    Busy superseded() {
        ++superseded_;
        return {message<"busy.superseded">(), 0};
    }

    void supersede(const Turn& turn) {
        if (turn.session.empty()) return;
        if (std::int64_t* newest = newest_.find(turn.session)) {
            if (turn.seq < *newest) throw superseded();
            *newest = turn.seq;
        } else {
            newest_.put(turn.session, turn.seq, 1);
        }
        const auto older = [&](const std::shared_ptr<Ticket>& one) {
            one->superseded =
                one->superseded || (one->turn.session == turn.session && one->turn.seq < turn.seq);
            return one->superseded;
        };
        if (std::erase_if(queue_, older) > 0) taken_.notify_all();
    }

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

    /// Estimates when the queued and running jobs end, by the mean duration of recent jobs.
    int retryAfterS() const {
        const auto workers = static_cast<double>(std::max<std::size_t>(1, idle_.size()) +
                                                 static_cast<std::size_t>(busy_));
        const auto jobs = static_cast<double>(queue_.size() + static_cast<std::size_t>(busy_));
        return static_cast<int>(std::clamp(std::ceil(jobs * meanS_ / workers), 1.0, 60.0));
    }

    const QueueLimits limits_;
    mutable std::mutex mutex_;
    std::condition_variable taken_;
    std::deque<std::shared_ptr<Ticket>> queue_;
    std::deque<Seat*> idle_;                                    ///< longest free first
    LruCache<std::string, std::int64_t> newest_{kMaxSessions};  ///< seq, by session
    int busy_ = 0;
    double meanS_ = 0.1;  ///< of a job, over the last few
    long superseded_ = 0;
    bool closed_ = false;
};

}  // namespace farol::worker
