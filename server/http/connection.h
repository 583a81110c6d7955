#pragma once

#include <atomic>
#include <memory>

#include "server/http/arrival.h"
#include "server/http/link.h"
#include "server/http/message.h"

namespace farol::server::http {

/// A request whose response is being sent.
struct Answered {
    Request request;
    Response response;  ///< without its body
    Clock::time_point since;
    bool keep = false;   ///< the connection may be kept for the next request
    bool isCut = false;  ///< more of the request may still arrive: read it and discard it
};

/// Returns an id that is unique in this process, and most likely among processes.
std::string newRequestId();

/// Answers one request after another; not thread-safe. Hides the HTTP library from other
/// headers.
class Connection {
  public:
    explicit Connection(Handler& handler);
    ~Connection();

    /// Calls the handler and sends its response as far as the socket accepts it now; the rest stays
    /// pending in the link. While `isClosing` is true, responses announce the end of the
    /// connection.
    Answered answer(Link& link, Incoming incoming, const std::atomic<bool>& isClosing);

  private:
    class Parser;
    std::unique_ptr<Parser> parser_;
};

}  // namespace farol::server::http
