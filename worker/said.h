#pragma once

#include <functional>
#include <string>
#include <thread>

namespace farol::worker {

/// The output of worker processes and their libraries, as lines for the log, so that a decoder's
/// complaint does not stand between the lines of JSON. A worker that prints faster than it is read
/// loses what is too much; it never waits.
class Said {
  public:
    using Sink = std::function<void(const std::string& line)>;
    /// A separate thread calls `sink`. Throws std::runtime_error.
    explicit Said(Sink sink);
    /// Reads what is there and ends.
    ~Said();
    Said(const Said&) = delete;
    Said& operator=(const Said&) = delete;

    /// The descriptor for a process to print to; closed on exec.
    int descriptor() const { return writeFd_; }

  private:
    void run();

    Sink sink_;
    int readFd_ = -1, writeFd_ = -1;
    std::thread thread_;
};

}  // namespace farol::worker
