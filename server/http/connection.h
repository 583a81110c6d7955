#pragma once

#include <atomic>
#include <memory>

#include "server/http/arrival.h"
#include "server/http/link.h"
#include "server/http/message.h"

namespace farol::server::http {

/// A request whose answer is on its way to the client.
struct Answered {
    Request request;
    Response response;  ///< without its body
    Clock::time_point since;
    bool keep = false;   ///< the connection may be kept for the next request
    bool isCut = false;  ///< more of this one may still come: to be taken, and left
};

/// Unlike all before it in this process, and most likely in others.
std::string newRequestId();

/// Answers one request after another: one object a thread. The HTTP library stays behind this
/// header.
class Connection {
  public:
    explicit Connection(Handler& handler);
    ~Connection();

    /// Has the handler answer and puts the answer on the link, which is sent as far as the client
    /// takes it now. `isClosing` turns true when the response must announce that no other request
    /// will be answered.
    Answered answer(Link& link, Incoming incoming, const std::atomic<bool>& isClosing);

  private:
    class Parser;
    std::unique_ptr<Parser> parser_;
};

}  // namespace farol::server::http
