#pragma once

#include <chrono>
#include <cstddef>
#include <mutex>
#include <string>

namespace farol::cli {

/// Shows how far a long work is, on stderr: a bar on a terminal, else a line for each tenth. May be
/// called by several threads.
class Progress {
  public:
    /// `work` begins each line: "grading".
    explicit Progress(std::string work) : work_(std::move(work)) {}
    /// 0 < done <= all.
    void operator()(std::size_t done, std::size_t all);

  private:
    const std::string work_;
    const bool isTerminal_ = isStderrTerminal();
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    std::size_t tenth_ = 0;
    std::mutex mutex_;

    static bool isStderrTerminal();
};

}  // namespace farol::cli
