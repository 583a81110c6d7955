#include "server/worker/pool.h"

#include <algorithm>

#include "render/encode.h"
#include "scene/digest.h"

namespace farol::server::worker {
namespace {

// How often an idle worker is looked at, so that one that died is replaced before it is needed.
constexpr std::chrono::milliseconds kLook{200};
// How often a request is begun whose worker somebody else kills. That is not the request's doing,
// unless the kernel did it for want of memory: so not often.
constexpr int kTries = 3;

// A start takes a core for a quarter of a second: side by side pays up to a few.
constexpr int kStarters = 4;

WorkerOptions withSaid(WorkerOptions options, int descriptor) {
    options.said = descriptor;
    return options;
}

QueueLimits withSlack(QueueLimits limits) {
    // The slot's thread keeps the deadline; the queue's own comes into play only if it cannot.
    limits.deadline += std::chrono::seconds(5);
    return limits;
}

/// What a worker that has the scene warm is found by, and what a quarantine is for.
std::string sceneOf(const render::Job& job) {
    if (!job.identity.empty()) return job.identity;
    std::string all = job.name + "\n" + job.xml + "\n";
    if (const auto* folder = dynamic_cast<const scene::FolderAssets*>(job.assets.get()))
        all += folder->root();
    else if (job.assets)
        for (const std::string& path : job.assets->list())
            all += path + "\n" + job.assets->version(path) + "\n";
    return scene::contentDigest(all);
}

}  // namespace

WorkerPool::WorkerPool(PoolOptions options, Logger& logger)
    : options_(std::move(options)),
      logger_(logger),
      said_([this](const std::string& line) { logger_.event("worker-said", line); }),
      nursery_({withSaid(options_.worker, said_.descriptor()),
                std::max(1, std::min(options_.workers, kStarters)), options_.spares},
               [this](const std::string& fault) {
                   logger_.event("worker-start", fault);
                   const std::lock_guard lock(mutex_);
                   anyFailed_ = true;
                   changed_.notify_all();
               }),
      queue_(withSlack(options_.queue)),
      quarantine_(options_.quarantine) {
    nursery_.begin(options_.workers);
    for (int i = 0; i < options_.workers; ++i) threads_.emplace_back([this, i] { run(i); });
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return anyReady_ || anyFailed_; });
}

WorkerPool::~WorkerPool() { stop(); }

void WorkerPool::stop() {
    {
        const std::lock_guard lock(mutex_);
        stopping_ = true;
    }
    nursery_.stop();
    queue_.close();
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
}

// One thread a worker: it starts, asks, ends and replaces it.
void WorkerPool::run(int index) {
    Slot slot;
    slot.index = index;
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
    slot.process.reset();
    const std::lock_guard lock(mutex_);
    pids_.erase(index);
}

bool WorkerPool::ready(Slot& slot, std::chrono::milliseconds patience) {
    if (slot.process && !slot.process->alive()) drop(slot, "idle");
    if (slot.process && slot.jobs >= options_.recycleAfter) drop(slot, "recycled");
    if (slot.process) return true;
    slot.process = nursery_.take(patience);
    if (!slot.process) return false;
    {
        const std::lock_guard lock(mutex_);
        pids_[slot.index] = slot.process->pid();
        if (facts_.sandbox.empty()) {
            facts_ = {slot.process->hello().gl, slot.process->hello().sandbox};
            for (const auto& [layer, state] : facts_.sandbox)
                if (state.starts_with("missing")) logger_.event("sandbox", layer + ": " + state);
        }
        anyReady_ = true;
    }
    changed_.notify_all();
    return true;
}

void WorkerPool::drop(Slot& slot, const std::string& reason) {
    slot.process.reset();
    slot.jobs = 0;
    {
        const std::lock_guard lock(mutex_);
        ++restarts_[reason];
        pids_.erase(slot.index);
    }
    if (reason != "recycled") logger_.event("worker-restart", reason);
}

void WorkerPool::admit(const std::string& scene) {
    if (const auto left = quarantine_.left(scene); left.count() > 0)
        throw Busy("worker.quarantine",
                   "This scene ended two workers one after the other; it is not tried again yet.",
                   static_cast<int>(left.count()));
}

Reply WorkerPool::askSlot(Slot& slot, const std::string& request, const std::string& scene) {
    const Clock::time_point end = Clock::now() + options_.queue.deadline;
    for (int tries = 1;; ++tries) {
        if (slot.process && !slot.process->alive()) drop(slot, "idle");
        if (!slot.process && !ready(slot, options_.replacement))
            throw Busy("worker.crashed", "No worker could be started for this request.", 2);
        ++slot.jobs;
        try {
            Reply reply = slot.process->call(
                request, std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()));
            // A heap that was full once is not worth keeping.
            if (reply.outcome == Outcome::memory)
                drop(slot, "memory");
            else if (!scene.empty())
                quarantine_.success(scene);
            return reply;
        } catch (const WorkerLost& lost) {
            logger_.event("worker-lost", lost.what());
            excuse(slot, lost, scene);
        }
        if (tries == kTries || Clock::now() >= end)
            throw Busy("worker.killed", "The workers that had this request were ended.", 1);
        ++retried_;
    }
}

// Returns where the request is not to blame, so that it may be begun again; else throws why not.
void WorkerPool::excuse(Slot& slot, const WorkerLost& lost, const std::string& scene) {
    using Why = WorkerLost::Why;
    if (lost.why() == Why::killed || lost.why() == Why::idle) {
        drop(slot, lost.why() == Why::idle ? "idle" : "killed");
        return;
    }
    if (!scene.empty()) quarantine_.strike(scene);
    const bool isLate = lost.why() == Why::late;
    drop(slot, isLate ? "deadline" : "crash");
    if (isLate) throw Busy("busy.deadline", "The work was not done in time.", 1);
    throw Busy("worker.crashed", "The worker that had this request crashed.", 1);
}

Reply WorkerPool::judged(Reply reply) const {
    switch (reply.outcome) {
        case Outcome::done:
            return reply;
        case Outcome::refused:
            if (reply.diagnostics.empty()) throw std::runtime_error("a worker refused in silence");
            throw Error(std::move(reply.diagnostics));
        case Outcome::memory:
            throw Error("limit.memory", "The scene needs more memory than a worker may take (" +
                                            std::to_string(options_.worker.memoryBytes >> 20U) +
                                            " MiB).");
        case Outcome::broken:
            break;
    }
    throw std::runtime_error(reply.message);
}

// What is packed is shared: a caller that gives up leaves it behind.
Done<Reply> WorkerPool::ask(std::string packed, const std::string& scene, const Turn& turn) {
    if (!scene.empty()) admit(scene);
    const auto request = std::make_shared<const std::string>(std::move(packed));
    Done<Reply> done = queue_.run<Reply>(
        [this, request, scene](Slot& slot) { return askSlot(slot, *request, scene); }, scene, turn);
    done.result = judged(std::move(done.result));
    return done;
}

Done<render::Picture> WorkerPool::draw(const render::Job& job, std::string packed,
                                       const Turn& turn) {
    Done<Reply> done = ask(std::move(packed), sceneOf(job), turn);
    // A worker that is not ours any more must not choose a header of the answer.
    done.result.picture.contentType = render::contentType(job.options.format);
    return {std::move(done.result.picture), done.queueMs};
}

Done<render::Picture> WorkerPool::render(const render::Job& job, const std::string& tag,
                                         const Turn& turn) {
    Request request;
    request.task = Task::render;
    request.job = job;
    std::string packed = pack(request);
    const std::string key = tag.empty() ? scene::contentDigest(packed) : tag;
    std::promise<Done<render::Picture>> promise;
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
            // Whoever asked first was overtaken by a frame of its own session, not by one of ours.
            if (busy.code() != "busy.superseded") throw;
            --coalesced_;
        }
    }
    const auto forget = [&] {
        const std::lock_guard lock(mutex_);
        inFlight_.erase(key);
    };
    try {
        Done<render::Picture> done = draw(job, std::move(packed), turn);
        forget();
        promise.set_value(done);
        return done;
    } catch (...) {
        forget();
        promise.set_exception(std::current_exception());
        throw;
    }
}

void WorkerPool::expectRoom(const std::string& tag, const Turn& turn) const {
    {
        const std::lock_guard lock(mutex_);
        if (inFlight_.count(tag) > 0) return;
    }
    queue_.expectRoom(turn);
}

Done<render::SceneReport> WorkerPool::inspect(const render::Job& job) {
    Request request;
    request.task = Task::inspect;
    request.job = job;
    Done<Reply> done = ask(pack(request), sceneOf(job));
    return {std::move(done.result.report), done.queueMs};
}

Done<std::string> WorkerPool::mesh(const MeshJob& job) {
    Request request;
    request.task = Task::mesh;
    request.mesh = job;
    Done<Reply> done = ask(pack(request), "");
    return {std::move(done.result.mesh), done.queueMs};
}

Done<render::Picture> WorkerPool::turntable(const render::Job& job, const Turntable& turn) {
    Request request;
    request.task = Task::turntable;
    request.job = job;
    request.turntable = turn;
    Done<Reply> done = ask(pack(request), sceneOf(job));
    done.result.picture.contentType =
        turn.apng ? "image/apng"
                  : std::string("multipart/x-mixed-replace; boundary=") + kFrameBoundary;
    return {std::move(done.result.picture), done.queueMs};
}

Done<render::Picture> WorkerPool::notice(const std::string& text,
                                         const render::PictureOptions& options) {
    Request request;
    request.task = Task::notice;
    request.notice = text;
    request.job.options = options;
    Done<Reply> done = ask(pack(request), "");
    done.result.picture.contentType = render::contentType(options.format);
    return {std::move(done.result.picture), done.queueMs};
}

Done<scene::Bundle> WorkerPool::unpack(const std::string& archive) {
    Request request;
    request.task = Task::unpack;
    request.job.archive = archive;
    Done<Reply> done = ask(pack(request), scene::contentDigest(archive));
    // A worker that is not ours any more must not choose what is written where.
    for (const auto& [path, content] : done.result.bundle.files)
        if (!scene::isSafePath(path)) throw std::runtime_error("a worker unpacked an unsafe path");
    if (done.result.bundle.files.count(done.result.bundle.main) == 0)
        throw std::runtime_error("a worker unpacked no scene");
    return {std::move(done.result.bundle), done.queueMs};
}

Done<GradeReply> WorkerPool::grade(const GradeJob& job) {
    Request request;
    request.task = Task::grade;
    request.job = job.submission.job;
    request.grade = job;
    // Any worker may take it: all have the reference warm after their first.
    Done<Reply> done = ask(pack(request), "");
    return {std::move(done.result.grade), done.queueMs};
}

Done<CompareReply> WorkerPool::compare(const CompareJob& job) {
    Request request;
    request.task = Task::compare;
    request.compare = job;
    Done<Reply> done = ask(pack(request), "");
    return {std::move(done.result.compare), done.queueMs};
}

void WorkerPool::check() { ask(pack(Request{}), ""); }

BackendState WorkerPool::state() const {
    BackendState state = queue_.state();
    state.coalesced = coalesced_;
    state.retried = retried_;
    const std::lock_guard lock(mutex_);
    state.workers = static_cast<int>(pids_.size());
    state.restarts = restarts_;
    return state;
}

BackendFacts WorkerPool::facts() const {
    const std::lock_guard lock(mutex_);
    return facts_;
}

std::vector<pid_t> WorkerPool::pids() const {
    const std::lock_guard lock(mutex_);
    std::vector<pid_t> all;
    for (const auto& [index, pid] : pids_) all.push_back(pid);
    return all;
}

std::string WorkerPool::version() const { return render::version(); }

}  // namespace farol::server::worker
