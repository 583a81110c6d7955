#pragma once

#include <functional>
#include <string>
#include <thread>

namespace farol::worker {

/// Collects the output of worker processes and their libraries as lines for the log, which keeps
/// messages of decoders out of the lines of JSON. Drops excess lines of a worker that prints
/// faster than it is read: a worker never waits for the log.
class WorkerOutput {
  public:
    using Sink = std::function<void(const std::string& line)>;
    /// A separate thread calls `sink`. Throws std::runtime_error.
    explicit WorkerOutput(Sink sink);
    /// Forwards the pending output and ends.
    ~WorkerOutput();
    WorkerOutput(const WorkerOutput&) = delete;
    WorkerOutput& operator=(const WorkerOutput&) = delete;

    /// The descriptor for a process to print to; closed on exec.
    int descriptor() const { return writeFd_; }

  private:
    void run();

    Sink sink_;
    int readFd_ = -1, writeFd_ = -1;
    std::thread thread_;
};

}  // namespace farol::worker
