#pragma once

#include <sys/types.h>

#include <string>

namespace farol::test {

/// `farol serve` with the example scenes on a free port of the loopback, as its own process.
class Service {
  public:
    Service();
    ~Service();
    Service(const Service&) = delete;
    Service& operator=(const Service&) = delete;

    const std::string& url() const { return url_; }
    /// Asks it to end by SIGTERM; its exit code, or 128 + the signal that ended it.
    int stop();

  private:
    pid_t process_ = -1;
    int output_ = -1;
    std::string url_;
};

}  // namespace farol::test
