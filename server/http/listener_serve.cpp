#include <poll.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string_view>

#include "server/http/listener.h"

namespace farol::server::http {
namespace {

constexpr int kNextMs = 2;
constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";

}  // namespace

// ---- All threads

void Listener::watch(const Client& client) const {
    epoll_event event{};
    event.events = EPOLLONESHOT;
    if (client.link.isPending() && !client.link.isHeld()) event.events |= EPOLLOUT;
    if (client.phase != Phase::sending && client.phase != Phase::holding)
        event.events |= EPOLLIN | EPOLLRDHUP;
    event.data.fd = client.link.fd();
    ::epoll_ctl(epollFd_, EPOLL_CTL_MOD, client.link.fd(), &event);
}

void Listener::count(Client& client) {
    const std::size_t held = client.link.held() + client.arrival.held();
    buffered_ += held - client.held;
    client.held = held;
    if (buffered_ > options_.bufferBytes) wake();
}

void Listener::enter(Client& client, Phase phase, Clock::time_point since,
                     std::chrono::milliseconds patience) {
    count(client);
    const std::lock_guard lock(mutex_);
    client.phase = phase;
    client.since = since;
    client.until = since + patience;
    watch(client);
}

void Listener::await(Client& client) {
    const Timeouts& timeouts = options_.timeouts;
    if (client.arrival.mustSayContinue()) {
        client.link.put(kContinue);
        client.link.flush();
    }
    const Arrival::State state = client.arrival.state();
    if (state == Arrival::State::nothing)  // a blank line does not prolong the wait
        enter(client, Phase::idle, client.phase == Phase::idle ? client.since : Clock::now(),
              options_.keepAlive);
    else
        enter(client, Phase::receiving, client.arrival.since(),
              state == Arrival::State::head ? timeouts.head : timeouts.body);
}

void Listener::activate(Client& client) {
    count(client);
    {
        const std::lock_guard lock(mutex_);
        queue_.push_back(&client);  // first: it may find no memory
        client.phase = Phase::active;
    }
    ready_.notify_one();
}

void Listener::end(Client& client, bool isCut) {
    const bool mayHaveMore =
        isCut || !client.link.in().empty() || client.link.receive() == Link::Got::bytes;
    if (!mayHaveMore) return drop(client);
    client.link.endSending();
    client.link.in().clear();
    enter(client, Phase::lingering, Clock::now(), options_.timeouts.linger);
}

void Listener::drop(Client& client) {
    const int fd = client.link.fd();
    {
        const std::lock_guard lock(mutex_);
        buffered_ -= client.held;
        if (const auto found = networks_.find(client.network); --found->second == 0)
            networks_.erase(found);
        clients_.erase(fd);
    }
    ::close(fd);
    if (stopping_) wake();
}

// ---- Threads that handle requests

void Listener::serveLoop() {
    Connection connection(handler_);
    for (;;) {
        Client* client = nullptr;
        {
            std::unique_lock lock(mutex_);
            ready_.wait(lock, [this] { return !queue_.empty() || ended_; });
            if (queue_.empty()) return;
            client = queue_.front();
            queue_.pop_front();
        }
        serve(*client, connection);
    }
}

bool Listener::othersWait() const {
    const std::lock_guard lock(mutex_);
    return !queue_.empty();
}

// The next request of a client that sends them one after another arrives at once: reading it here
// saves two wake-ups. Only while no other request waits for a thread.
bool Listener::nextIsHere(Client& client) {
    if (othersWait()) return false;
    pollfd wait{client.link.fd(), POLLIN, 0};
    if (::poll(&wait, 1, kNextMs) != 1 || wait.revents != POLLIN) return false;
    if (client.link.receive() != Link::Got::bytes) return false;  // its end is seen by the mover
    client.arrival.feed(client.link.in());
    return client.arrival.state() == Arrival::State::whole;
}

void Listener::serve(Client& client, Connection& connection) {
    for (;;) {
        if (client.answered) {
            if (client.link.isHeld() && !client.link.isBroken())
                return enter(client, Phase::holding, Clock::now(), client.answered->response.hold);
            if (client.link.isPending())
                return enter(client, Phase::sending, Clock::now(), options_.timeouts.write);
            const Answered done = std::move(*client.answered);
            client.hasAsked = true;
            client.answered.reset();
            const bool sent = !client.link.isBroken();
            const std::chrono::duration<double, std::milli> took = Clock::now() - done.since;
            handler_.finished(done.request, done.response, took.count(), sent);
            if (!sent) return drop(client);
            if (!done.keep || stopping_) return end(client, done.isCut);
            client.arrival.feed(client.link.in());
            if (client.arrival.state() != Arrival::State::whole) {
                if (!nextIsHere(client)) return await(client);
            } else if (othersWait()) {
                return activate(client);  // behind them
            }
        }
        Incoming incoming = client.arrival.take();
        incoming.head.request.remoteAddress = client.remoteAddress;
        incoming.head.request.isGone = [&link = client.link] { return link.isAtEnd(); };
        client.answered = connection.answer(client.link, std::move(incoming), closing_);
        count(client);
    }
}

}  // namespace farol::server::http
