#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "server/http/message.h"

namespace farol::server::http {

/// How long a client may take. All are wall-clock bounds on the whole step, not on one read.
struct Timeouts {
    std::chrono::milliseconds head{10'000};  ///< from its first byte to its blank line
    std::chrono::milliseconds body{30'000};
    std::chrono::milliseconds write{30'000};
    std::chrono::milliseconds linger{1'000};  ///< after an answer that ends the connection
};

/// Serves the requests of one connection at a time: one object a thread. The HTTP library stays
/// behind this header.
class Connection {
  public:
    Connection(Handler& handler, Timeouts timeouts);
    ~Connection();

    /// Serves the requests that have arrived on the socket, whole or too late. True: the connection
    /// may be kept for the next one. `closing` is asked after each answer.
    bool serve(int fd, const std::string& remoteAddress, const std::function<bool()>& closing);

  private:
    class Parser;
    std::unique_ptr<Parser> parser_;
};

}  // namespace farol::server::http
