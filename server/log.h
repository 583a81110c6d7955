#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "server/http/message.h"

namespace farol::server {

/// One line of JSON a request: time, id, method, path, status, bytes, ms and what the handler
/// adds. Threads may share it: one writes, the others leave their lines to it and go on, unless
/// whoever reads the log is far behind.
class Logger {
  public:
    /// Gets each line, without its end; null writes to stderr.
    using Sink = std::function<void(const std::string&)>;
    explicit Logger(Sink sink = nullptr);

    void request(const http::Request& request, const http::Response& response, double milliseconds,
                 bool sent);
    /// Anything else worth a line.
    void event(const std::string& name, const std::string& message);

  private:
    void write(std::string line);
    void put(const std::vector<std::string>& lines) const;

    Sink sink_;
    std::mutex mutex_;
    std::condition_variable room_;
    std::vector<std::string> waiting_;  ///< for the thread that writes
    std::size_t waitingBytes_ = 0;
    bool isWriting_ = false;
};

}  // namespace farol::server
