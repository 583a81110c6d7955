#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "cli/report.h"

namespace farol::cli {

/// Ends the process with kInputFault and limit.deadline when work takes longer than it may: a frame
/// cannot be broken off in the GL. Make it after the process is closed in, since it has a thread.
class Deadline {
  public:
    /// `seconds` from now; 0: none. Its error is reported as lines or JSON as `report` would, about
    /// the input `name`.
    Deadline(double seconds, const Report& report, std::string name);
    Deadline(const Deadline&) = delete;
    Deadline& operator=(const Deadline&) = delete;
    ~Deadline() { release(); }
    /// The work is done in time; where it is not, this does not return.
    void release();

  private:
    void expire(double seconds, bool json, const std::string& name);
    std::mutex mutex_;
    std::condition_variable released_;
    bool isReleased_ = false;
    std::thread thread_;
};

}  // namespace farol::cli
