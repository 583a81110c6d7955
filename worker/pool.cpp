#include "worker/pool.h"

#include <algorithm>

#include "render/renderer.h"
#include "worker/messages.h"
#include "worker/process_usage.h"

namespace farol::worker {
namespace {

// Interval of checks of idle workers, so that a dead one is replaced before it is needed.
constexpr std::chrono::milliseconds kLook{200};
// Most attempts of a request whose worker is killed from outside. That is not the request's
// fault, unless the kernel ran out of memory: so few.
constexpr int kTries = 3;

// A start takes a core for a quarter of a second: parallel starts pay up to a few.
constexpr int kStarters = 4;

// Processor time that a worker without a job may use: freeing memory, writing caches.
constexpr std::chrono::seconds kIdleCpu{1};

WorkerOptions withOutput(WorkerOptions options, int descriptor) {
    options.said = descriptor;
    return options;
}

QueueLimits withSlack(QueueLimits limits) {
    // The slot's thread keeps the deadline; the queue's own comes into play only if it cannot.
    limits.deadline += std::chrono::seconds(5);
    return limits;
}

/// The caller of a job, which may give up before the job ends.
class Caller {
  public:
    explicit Caller(std::function<bool()> isGone) : isGone_(std::move(isGone)) {}
    bool isGone() {
        const std::lock_guard lock(mutex_);
        return hasLeft_ || (isGone_ && isGone_());
    }
    /// Its function is not called any more.
    void leave() {
        const std::lock_guard lock(mutex_);
        hasLeft_ = true;
    }

  private:
    std::mutex mutex_;
    const std::function<bool()> isGone_;
    bool hasLeft_ = false;
};

int sparesOf(const PoolOptions& options) {
    return options.isolatesUploads ? std::max(options.spares, options.workers) : options.spares;
}

}  // namespace

WorkerPool::WorkerPool(PoolOptions options, EventLog log)
    : options_(std::move(options)),
      log_(std::move(log)),
      output_([this](const std::string& line) { log_("worker-said", line); }),
      spawner_({withOutput(options_.worker, output_.descriptor()),
                std::max(1, std::min(options_.workers, kStarters)), sparesOf(options_)},
               [this](const std::string& fault) {
                   log_("worker-start", fault);
                   const std::lock_guard lock(mutex_);
                   anyFailed_ = true;
                   changed_.notify_all();
               }),
      queue_(withSlack(options_.queue)),
      quarantine_(options_.quarantine),
      version_(render::version(options_.worker.gl)) {
    spawner_.begin(options_.workers);
    for (int i = 0; i < options_.workers; ++i) threads_.emplace_back([this, i] { serveSlot(i); });
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return anyReady_ || anyFailed_; });
}

WorkerPool::~WorkerPool() { stop(); }

void WorkerPool::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    spawner_.stop();
    queue_.close();
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
}

// One thread a worker: it starts, asks, ends and replaces it.
void WorkerPool::serveSlot(int index) {
    Slot slot;
    // The first generation ends one after the other, so that not all are replaced at once.
    slot.jobs = static_cast<long>(options_.recycleAfter) * index / options_.workers;
    Queue::Seat seat;
    for (;;) {
        if (!ready(slot, kLook)) {
            const std::lock_guard lock(mutex_);
            if (stopping_) break;
            continue;
        }
        if (!queue_.workOnce(slot, seat, kLook)) break;
    }
    if (!slot.process) return;
    slot.process.reset();
    const std::lock_guard lock(mutex_);
    --ready_;
}

bool WorkerPool::ready(Slot& slot, std::chrono::milliseconds patience) {
    if (slot.process && !slot.process->alive()) drop(slot, "idle");
    if (slot.process && slot.process->isStale()) drop(slot, "folder");
    if (slot.process && slot.jobs >= options_.recycleAfter) drop(slot, "recycled");
    if (slot.process && slot.isSpent) drop(slot, "isolated");
    if (slot.process && cpuTimeOf(slot.process->pid()) - slot.cpuWhenIdle > kIdleCpu)
        drop(slot, "busy");
    if (slot.process) return true;
    slot.process = spawner_.take(patience);
    if (!slot.process) return false;
    slot.cpuWhenIdle = cpuTimeOf(slot.process->pid());
    {
        const std::lock_guard lock(mutex_);
        ++ready_;
        if (facts_.sandbox.empty()) {
            facts_ = {slot.process->hello().gl, slot.process->hello().sandbox};
            for (const auto& [layer, state] : facts_.sandbox)
                if (state.starts_with("missing")) log_("sandbox", layer + ": " + state);
        }
        anyReady_ = true;
    }
    changed_.notify_all();
    return true;
}

void WorkerPool::drop(Slot& slot, const std::string& reason) {
    slot.process.reset();
    slot.jobs = 0;
    slot.isSpent = false;
    {
        const std::lock_guard lock(mutex_);
        ++restarts_[reason];
        --ready_;
    }
    if (reason != "recycled" && reason != "isolated") log_("worker-restart", reason);
}

void WorkerPool::admit(const JobIdentity& identity) {
    const Quarantine::Closed closed = quarantine_.closed(identity);
    if (closed.left.count() == 0) return;
    const auto seconds = static_cast<int>(closed.left.count());
    throw Busy(closed.isScene ? message<"worker.quarantine/scene">("seconds"_arg = seconds)
                              : message<"worker.quarantine">("seconds"_arg = seconds),
               seconds);
}

Answer WorkerPool::askSlot(Slot& slot, const PackedJob& job, const std::function<bool()>& isGone) {
    const Clock::time_point end = Clock::now() + options_.queue.deadline;
    for (int tries = 1;; ++tries) {
        if (slot.process && !slot.process->alive()) drop(slot, "idle");
        auto patience = options_.queue.wait;
        if (slot.process && slot.process->isStale()) {
            drop(slot, "folder");
            // The spares are stale, too.
            patience = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
        }
        if (!slot.process && !ready(slot, patience))
            throw Busy(message<"worker.crashed/start">(), 2);
        if (isGone()) throw Busy(message<"busy.cancelled">(), 1);
        ++slot.jobs;
        try {
            CallLimits limits;
            limits.isGone = isGone;
            limits.cpu = options_.cpu.count() > 0 ? options_.cpu : 2 * options_.queue.deadline;
            limits.deadline = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now());
            Answer answer = slot.process->call(job, limits);
            if (answer.outcome == Outcome::memory) {
                // Replaces the process, whose heap was full.
                drop(slot, "memory");
                quarantine_.strike(job.identity, Quarantine::Cause::exhausted);
            } else if (answer.outcome != Outcome::cancelled) {
                quarantine_.success(job.identity);
            }
            return answer;
        } catch (const WorkerLost& lost) {
            log_("worker-lost", lost.what());
            excuse(slot, lost, job.identity);
        }
        if (tries == kTries || Clock::now() >= end) throw Busy(message<"worker.killed">(), 1);
        ++retried_;
    }
}

// Returns where the request is not to blame and may be begun again; else throws why not.
void WorkerPool::excuse(Slot& slot, const WorkerLost& lost, const JobIdentity& identity) {
    using Why = WorkerLost::Why;
    using Cause = Quarantine::Cause;
    switch (lost.why()) {
        case Why::killed:
            return drop(slot, "killed");
        case Why::idle:
            return drop(slot, "idle");
        case Why::stalled:
            drop(slot, "stalled");
            throw Busy(message<"busy.deadline/processor">(), 1);
        case Why::late:
            quarantine_.strike(identity, Cause::exhausted);
            drop(slot, "deadline");
            throw Busy(message<"busy.deadline">(), 1);
        case Why::cpu:
            quarantine_.strike(identity, Cause::exhausted);
            drop(slot, "cpu");
            throw Error(message<"limit.cpu">());
        case Why::reply:
            quarantine_.strike(identity, Cause::crash);
            drop(slot, "reply");
            throw Busy(message<"worker.reply">(), 1);
        case Why::crash:
            break;
    }
    quarantine_.strike(identity, Cause::crash);
    drop(slot, "crash");
    throw Busy(message<"worker.crashed">(), 1);
}

void WorkerPool::judge(Answer& answer) const {
    switch (answer.outcome) {
        case Outcome::done:
            return;
        case Outcome::refused:
            throw Error(std::move(answer.diagnostics));
        case Outcome::cancelled:
            throw Busy(message<"busy.cancelled">(), 1);
        case Outcome::memory:
            throw Error(message<"limit.memory">("max"_arg = options_.worker.memoryBytes >> 20U));
        case Outcome::broken:
            break;
    }
    throw std::runtime_error(answer.message);
}

// The job is shared: a caller that gives up leaves it behind.
Done<std::any> WorkerPool::ask(PackedJob job, const RunOptions& options) {
    admit(job.identity);
    const auto shared = std::make_shared<const PackedJob>(std::move(job));
    const auto caller = std::make_shared<Caller>(options.isGone);
    const std::shared_ptr<void> leave(nullptr, [&](void*) { caller->leave(); });
    Done<Answer> done = queue_.run<Answer>(
        [this, shared, caller](Slot& slot) {
            Answer answer = askSlot(slot, *shared, [&] { return caller->isGone(); });
            if (slot.process) {
                slot.isSpent = options_.isolatesUploads && shared->isUpload;
                slot.cpuWhenIdle = cpuTimeOf(slot.process->pid());
            }
            return answer;
        },
        shared->identity.scene, options.turn);
    judge(done.result);
    return {std::move(done.result.reply), done.queueMs};
}

Done<std::any> WorkerPool::askCounted(PackedJob job, const RunOptions& options) {
    const std::string task(job.task);
    const auto count = [&](long JobCounts::*outcome, double seconds) {
        const std::lock_guard lock(mutex_);
        JobCounts& counts = jobs_[task];
        ++(counts.*outcome);
        counts.seconds += seconds;
    };
    const Clock::time_point begin = Clock::now();
    try {
        Done<std::any> done = ask(std::move(job), options);
        const std::chrono::duration<double> took = Clock::now() - begin;
        count(&JobCounts::done, std::max(0.0, took.count() - done.queueMs / 1000.0));
        return done;
    } catch (const Error&) {
        count(&JobCounts::refused, 0.0);
        throw;
    } catch (...) {
        count(&JobCounts::failed, 0.0);
        throw;
    }
}

Done<std::any> WorkerPool::submit(PackedJob job, const RunOptions& options) {
    if (!job.isShared) return askCounted(std::move(job), options);
    const std::string key = options.tag.empty() ? job.identity.request : options.tag;
    std::promise<Done<std::any>> promise;
    for (;;) {
        std::unique_lock lock(mutex_);
        const auto found = inFlight_.find(key);
        if (found == inFlight_.end()) {
            inFlight_.emplace(key, promise.get_future().share());
            break;
        }
        const Shared shared = found->second;
        lock.unlock();
        ++coalesced_;
        try {
            return shared.get();
        } catch (const Busy& busy) {
            // The first request was superseded by a frame of its session, not by one of this
            // session.
            if (busy.code() != "busy.superseded") throw;
            --coalesced_;
        }
    }
    const auto forget = [&] {
        const std::lock_guard lock(mutex_);
        inFlight_.erase(key);
    };
    try {
        // Others may share the reply: it is wanted even where its first client has gone.
        Done<std::any> done = askCounted(std::move(job), {options.tag, options.turn});
        forget();
        promise.set_value(done);
        return done;
    } catch (...) {
        forget();
        promise.set_exception(std::current_exception());
        throw;
    }
}

void WorkerPool::expectRoom(const RunOptions& options) const {
    {
        const std::lock_guard lock(mutex_);
        if (inFlight_.count(options.tag) > 0) return;
    }
    queue_.expectRoom(options.turn);
}

BackendState WorkerPool::state() const {
    BackendState state = queue_.state();
    state.coalesced = coalesced_;
    state.retried = retried_;
    const std::lock_guard lock(mutex_);
    state.workers = ready_;
    state.restarts = restarts_;
    state.jobs = jobs_;
    return state;
}

BackendFacts WorkerPool::facts() const {
    const std::lock_guard lock(mutex_);
    return facts_;
}

std::string WorkerPool::version() const { return version_; }

}  // namespace farol::worker
