#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

namespace farol::server {

/// Writes lines to a descriptor in a thread, in their order. write() never blocks: while the other
/// end is not read, drops and counts the lines over the queue's bound. Does the same if the
/// descriptor is closed, its reader has gone or its disk is full.
class LogWriter {
  public:
    struct Options {
        std::size_t queueBytes = std::size_t{1} << 20U;
        std::chrono::milliseconds patience{2'000};  ///< for queued lines when the writer ends
        /// Makes the line that reports how many were dropped; null: none is written.
        std::function<std::string(std::uint64_t)> notice;
    };
    /// Does not own the descriptor, which stays as it is (blocking or not).
    LogWriter(int fd, Options options);
    /// Writes the queued lines within Options::patience; a thread that is stuck in the kernel is
    /// left behind.
    ~LogWriter();
    LogWriter(const LogWriter&) = delete;
    LogWriter& operator=(const LogWriter&) = delete;

    /// `line` without its end. Threads may share the writer.
    void write(const std::string& line);
    std::uint64_t dropped() const;

  private:
    struct Queue;
    static void run(Queue& queue);

    std::shared_ptr<Queue> queue_;
    std::thread thread_;
};

}  // namespace farol::server
