#pragma once

#include <optional>
#include <string>

#include "server/http/body_reader.h"
#include "server/http/clock.h"
#include "server/http/head.h"

namespace farol::server::http {

/// A request as it is given to a thread: all that will be read of it.
struct Incoming {
    Head head;
    std::string body;
    BodyReader::State bodyState = BodyReader::State::whole;  ///< why the body is not all of it
    Clock::time_point since;                                 ///< when its head was there
};

/// Puts the next request of a connection together, so that a thread is spent on it only once it
/// is whole, or must be refused.
class Arrival {
  public:
    enum class State { nothing, head, body, whole };

    explicit Arrival(const Handler& handler) : handler_(&handler) {}

    /// Removes the bytes of the request from the front of `in`, and no more.
    void feed(std::string& in);
    /// Refuses the incomplete request, after a timeout or the end of the client's data.
    void giveUp(std::string& in);
    State state() const;
    /// Since when its head, or its body, is under way.
    Clock::time_point since() const { return since_; }
    /// True once, if the client waits for "100 Continue" before it sends its body.
    bool mustSayContinue();
    /// The request, which is whole; the next one can be fed.
    Incoming take();
    std::size_t held() const { return body_ ? body_->size() : 0; }

  private:
    void readHead(std::string& in);
    void refuse(Refusal refusal);

    const Handler* handler_;
    std::optional<Head> head_;
    std::optional<BodyReader> body_;
    std::size_t searched_ = 0;    ///< of the head, for its end
    std::size_t blankLines_ = 0;  ///< before the head
    bool begun_ = false, sayContinue_ = false;
    Clock::time_point since_, headAt_;
};

}  // namespace farol::server::http
