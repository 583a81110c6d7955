#pragma once

#include <functional>
#include <mutex>
#include <string>

#include "server/http/message.h"

namespace farol::server {

/// Milliseconds as the log writes them, rounded to a microsecond.
double toMicroseconds(double milliseconds);

/// Formats one line of JSON a request: time, id, method, path, status, bytes, ms and fields of the
/// handler. Thread-safe; the sink gets one line at a time.
class Logger {
  public:
    /// Gets each line, without its end; must not block. Null: nothing is logged.
    using Sink = std::function<void(const std::string&)>;
    explicit Logger(Sink sink);

    void request(const http::Request& request, const http::Response& response, double milliseconds,
                 bool sent);
    /// Logs any other event.
    void event(const std::string& name, const std::string& message);
    /// The line that event() logs.
    static std::string eventLine(const std::string& name, const std::string& message);

  private:
    void write(const std::string& line);

    Sink sink_;
    std::mutex mutex_;
};

}  // namespace farol::server
