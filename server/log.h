#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "server/http/message.h"

namespace farol::server {

/// One line of JSON a request: time, id, method, path, status, bytes, ms and what the handler
/// adds. Threads may share it.
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
    void write(const std::string& line);
    Sink sink_;
    std::mutex mutex_;
};

}  // namespace farol::server
