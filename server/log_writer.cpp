#include "server/log_writer.h"

#include <poll.h>
#include <pthread.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <mutex>
#include <string_view>
#include <utility>

namespace farol::server {
namespace {

// A pipe that poll() reports as writable has room for this many bytes (PIPE_BUF, pipe(7)).
constexpr std::size_t kPiece = 4096;
constexpr int kPollMs = 100;
// Interval whose lines are written together: fewer system calls and wake-ups.
constexpr std::chrono::milliseconds kCollect{5};
// For the thread to see that it is abandoned: longer than kPollMs.
constexpr std::chrono::milliseconds kAbandon{500};

/// Whole lines where they fit.
std::string_view pieceOf(std::string_view text) {
    if (text.size() <= kPiece) return text;
    const std::size_t end = text.rfind('\n', kPiece - 1);
    return text.substr(0, end == std::string_view::npos ? kPiece : end + 1);
}

}  // namespace

struct LogWriter::Queue {
    Queue(int descriptor, Options settings) : fd(descriptor), options(std::move(settings)) {}

    const int fd;
    const Options options;
    std::atomic<std::uint64_t> dropped{0};
    std::atomic<bool> isAbandoned{false};
    std::mutex mutex;  ///< guards the members below
    std::condition_variable changed;
    std::string lines;
    std::uint64_t reported = 0;  ///< of `dropped`
    bool isEnding = false, hasEnded = false;

    /// Returns the bytes that could not be written.
    std::string_view write(std::string_view text) const;
};

std::string_view LogWriter::Queue::write(std::string_view text) const {
    while (!text.empty()) {
        pollfd wait{fd, POLLOUT, 0};
        const int ready = ::poll(&wait, 1, kPollMs);
        if (isAbandoned) return text;
        if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
        const std::string_view piece = pieceOf(text);
        const ssize_t written = ::write(fd, piece.data(), piece.size());
        if (written > 0) {
            text.remove_prefix(static_cast<std::size_t>(written));
        } else if (written < 0 && errno == EAGAIN) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        } else if (written == 0 || errno != EINTR) {
            return text;
        }
    }
    return text;
}

void LogWriter::run(Queue& queue) {
    std::unique_lock lock(queue.mutex);
    for (;;) {
        queue.changed.wait(lock, [&] { return queue.isEnding || !queue.lines.empty(); });
        queue.changed.wait_for(lock, kCollect, [&] { return queue.isEnding; });
        if (queue.lines.empty()) break;
        std::string batch = std::exchange(queue.lines, {});
        const std::uint64_t dropped = queue.dropped;
        const std::uint64_t lost = dropped - std::exchange(queue.reported, dropped);
        lock.unlock();
        if (lost > 0 && queue.options.notice) batch += queue.options.notice(lost) + "\n";
        const std::string_view rest = queue.write(batch);
        queue.dropped += static_cast<std::uint64_t>(std::count(rest.begin(), rest.end(), '\n'));
        lock.lock();
    }
    queue.hasEnded = true;
    queue.changed.notify_all();
}

LogWriter::LogWriter(int fd, Options options)
    : queue_(std::make_shared<Queue>(fd, std::move(options))) {
    thread_ = std::thread([queue = queue_] {
        // A reader that has gone is an error of write().
        sigset_t pipe;
        sigemptyset(&pipe);
        sigaddset(&pipe, SIGPIPE);
        pthread_sigmask(SIG_BLOCK, &pipe, nullptr);
        run(*queue);
    });
}

LogWriter::~LogWriter() {
    std::unique_lock lock(queue_->mutex);
    queue_->isEnding = true;
    queue_->changed.notify_all();
    const auto hasEnded = [this] { return queue_->hasEnded; };
    if (!queue_->changed.wait_for(lock, queue_->options.patience, hasEnded)) {
        queue_->isAbandoned = true;
        queue_->changed.wait_for(lock, kAbandon, hasEnded);
    }
    const bool joins = queue_->hasEnded;
    lock.unlock();
    joins ? thread_.join() : thread_.detach();
}

void LogWriter::write(const std::string& line) {
    bool wasEmpty = false;
    {
        const std::lock_guard lock(queue_->mutex);
        if (queue_->lines.size() + line.size() >= queue_->options.queueBytes) {
            ++queue_->dropped;
            return;
        }
        wasEmpty = queue_->lines.empty();
        queue_->lines.append(line).append("\n");
    }
    if (wasEmpty) queue_->changed.notify_one();
}

std::uint64_t LogWriter::dropped() const { return queue_->dropped; }

}  // namespace farol::server
