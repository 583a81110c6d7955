#include "server/http/listener.h"

#include <poll.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "server/http/socket.h"

namespace farol::server::http {
namespace {

constexpr int kLookMs = 250;
constexpr std::chrono::milliseconds kSweep{100};
constexpr int kNextMs = 2;
// Reads of one connection before others have their turn: a megabyte.
constexpr int kReads = 16;
constexpr std::size_t kLingerBytes = std::size_t{64} << 20U;
constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";

// The answer to a client for whom there is no place: its request is not read.
std::string fullAnswer(Handler& handler) {
    Request unread;
    unread.id = newRequestId();
    Response full = handler.refuse(unread, 503, "busy.connections",
                                   "There are too many connections: try again in a moment.");
    full.set("Retry-After", "1");
    full.set("Connection", "close");
    full.set("Content-Type", full.contentType);
    full.set("Content-Length", std::to_string(full.body.size()));
    std::string bytes = "HTTP/1.1 503 Service Unavailable\r\n";
    for (const auto& [name, value] : full.headers)
        bytes.append(name).append(": ").append(value).append("\r\n");
    return bytes + "\r\n" + full.body;
}

}  // namespace

Listener::Listener(const ListenOptions& options, Handler& handler)
    : options_(options), handler_(handler) {
    listenFd_ = listenOn(options.host, options.port);
    port_ = portOf(listenFd_);
    epollFd_ = ::epoll_create1(EPOLL_CLOEXEC);
    wakeFd_ = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    if (epollFd_ < 0 || wakeFd_ < 0) {
        const int fault = errno;
        for (const int fd : {listenFd_, epollFd_, wakeFd_})
            if (fd >= 0) ::close(fd);
        throw std::runtime_error("cannot watch sockets: " + std::generic_category().message(fault));
    }
    for (const int fd : {listenFd_, wakeFd_}) {
        epoll_event event{};
        event.events = EPOLLIN;
        event.data.fd = fd;
        ::epoll_ctl(epollFd_, EPOLL_CTL_ADD, fd, &event);
    }
}

Listener::~Listener() {
    stop();
    for (const int fd : {listenFd_, epollFd_, wakeFd_})
        if (fd >= 0) ::close(fd);
}

void Listener::start() {
    for (int i = 0; i < options_.threads; ++i) threads_.emplace_back([this] { serveLoop(); });
    mover_ = std::thread([this] { moveLoop(); });
}

void Listener::stop() {
    stopping_ = true;
    wake();
    if (mover_.joinable()) mover_.join();
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    ready_.notify_all();
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
    const std::lock_guard lock(mutex_);
    for (const auto& [fd, client] : clients_) ::close(fd);
    clients_.clear();
}

void Listener::wake() const {
    const std::uint64_t one = 1;
    // It is full only when it has been written to and not been read: awake already.
    if (::write(wakeFd_, &one, sizeof one) < 0) return;
}

Traffic Listener::traffic() const {
    const std::lock_guard lock(mutex_);
    Traffic now = closed_;
    now.bufferedBytes = buffered_;
    for (const auto& [fd, client] : clients_) {
        switch (client->phase) {
            case Phase::idle:
                ++now.idle;
                break;
            case Phase::receiving:
                ++now.receiving;
                break;
            case Phase::active:
                ++now.active;
                break;
            case Phase::holding:
            case Phase::sending:
            case Phase::lingering:
                ++now.sending;
                break;
        }
    }
    return now;
}

// ---- The thread that moves bytes

void Listener::moveLoop() {
    std::array<epoll_event, 64> events;
    Clock::time_point stoppedAt{};
    while (!stopping_ || !isOver(stoppedAt)) {
        const int count =
            ::epoll_wait(epollFd_, events.data(), static_cast<int>(events.size()), kLookMs);
        for (int i = 0; i < count; ++i) {
            const int fd = events[static_cast<std::size_t>(i)].data.fd;
            if (fd == wakeFd_) {
                std::uint64_t times = 0;
                if (::read(wakeFd_, &times, sizeof times) < 0) continue;
            } else if (fd == listenFd_) {
                acceptAll();
            } else {
                look(fd);
            }
        }
        sweep();
        relieve();
        if (stopping_ && listenFd_ >= 0) {
            // From here on clients are refused by the kernel and may try elsewhere.
            ::close(listenFd_);
            listenFd_ = -1;
            stoppedAt = Clock::now();
        }
    }
}

// Requests of which the head has come are still answered, and answers leave.
bool Listener::isOver(Clock::time_point stoppedAt) {
    if (listenFd_ >= 0) return false;
    std::vector<Client*> idle;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [fd, client] : clients_)
            if (client->phase == Phase::idle || (client->phase == Phase::receiving &&
                                                 client->arrival.state() == Arrival::State::head))
                idle.push_back(client.get());
    }
    for (Client* client : idle) drop(*client);
    const std::lock_guard lock(mutex_);
    return clients_.empty() || Clock::now() - stoppedAt > options_.timeouts.grace;
}

void Listener::acceptAll() {
    for (;;) {
        std::string address;
        const int fd = acceptFrom(listenFd_, address);
        if (fd < 0) {
            if (errno == EINTR || errno == ECONNABORTED) continue;
            // Out of descriptors: those in use must come back first; do not spin on the event.
            if (errno != EAGAIN) std::this_thread::sleep_for(std::chrono::milliseconds(10));
            return;
        }
        auto client = std::make_unique<Client>(fd, handler_, std::move(address));
        client->since = Clock::now();
        client->until = client->since + options_.keepAlive;
        {
            const std::lock_guard lock(mutex_);
            if (clients_.size() >= static_cast<std::size_t>(options_.maxConnections)) {
                ++closed_.full;
                const std::string full = fullAnswer(handler_);
                (void)::send(fd, full.data(), full.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
                ::close(fd);
                continue;
            }
            clients_[fd] = std::move(client);
        }
        epoll_event event{};
        event.events = EPOLLIN | EPOLLRDHUP | EPOLLONESHOT;
        event.data.fd = fd;
        if (::epoll_ctl(epollFd_, EPOLL_CTL_ADD, fd, &event) != 0) {
            const std::lock_guard lock(mutex_);
            clients_.erase(fd);
            ::close(fd);
        }
    }
}

void Listener::look(int fd) {
    Client* client = nullptr;
    Phase phase{};
    {
        const std::lock_guard lock(mutex_);
        const auto found = clients_.find(fd);
        if (found == clients_.end() || found->second->phase == Phase::active) return;
        client = found->second.get();
        phase = client->phase;
    }
    if (phase == Phase::lingering) return linger(*client);
    if (phase == Phase::holding) return giveUp(*client, Phase::sending);  // it went away
    client->link.flush();
    count(*client);
    if (phase != Phase::sending) return receive(*client);
    if (client->link.isPending())
        watch(*client);
    else
        activate(*client);
}

void Listener::receive(Client& client) {
    for (int i = 0; i < kReads; ++i) {
        const Link::Got got = client.link.receive();
        if (got == Link::Got::nothing) break;
        if (got == Link::Got::closed) {
            if (client.arrival.state() != Arrival::State::body) return drop(client);
            client.arrival.giveUp(client.link.in());  // it may still read what we say to that
            return activate(client);
        }
        client.arrival.feed(client.link.in());
        if (client.arrival.state() == Arrival::State::whole) return activate(client);
    }
    await(client);
}

// What the client still sends is taken for a moment, so that it reads the answer instead of a
// reset (RFC 9112 section 9.6).
void Listener::linger(Client& client) {
    for (int i = 0; i < kReads; ++i) {
        const Link::Got got = client.link.receive();
        client.drained += client.link.in().size();
        client.link.in().clear();
        if (got == Link::Got::nothing) break;
        if (got == Link::Got::closed || client.drained > kLingerBytes) return drop(client);
    }
    watch(client);
}

void Listener::sweep() {
    const Clock::time_point now = Clock::now();
    if (now - swept_ < kSweep) return;
    swept_ = now;
    std::vector<std::pair<Client*, Phase>> late;
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [fd, client] : clients_) {
            const bool mayWait = !stopping_ || client->phase != Phase::holding;
            if (client->phase == Phase::active || (now < client->until && mayWait)) continue;
            late.emplace_back(client.get(), client->phase);
            if (client->phase == Phase::sending) ++closed_.slowReader;
            if (client->phase == Phase::receiving)
                ++(client->arrival.state() == Arrival::State::head ? closed_.slowHead
                                                                   : closed_.slowBody);
        }
    }
    for (const auto& [client, phase] : late) giveUp(*client, phase);
}

// A thread has the last word with a client that is too slow: to tell it so, or the log.
void Listener::giveUp(Client& client, Phase phase) {
    if (phase == Phase::idle || phase == Phase::lingering) return drop(client);
    if (phase == Phase::holding) {
        client.link.release();
        client.link.flush();
    } else if (phase == Phase::receiving)
        client.arrival.giveUp(client.link.in());
    else
        client.link.abandon();
    activate(client);
}

void Listener::relieve() {
    while (buffered_ > options_.bufferBytes) {
        Client* slowest = nullptr;
        Phase phase{};
        {
            const std::lock_guard lock(mutex_);
            for (const auto& [fd, client] : clients_)
                if (client->phase != Phase::active && client->held > 0 &&
                    (slowest == nullptr || client->since < slowest->since))
                    slowest = client.get();
            if (slowest == nullptr) return;  // all of it is with threads, of which there are few
            phase = slowest->phase;
            ++closed_.memory;
        }
        if (phase != Phase::sending && phase != Phase::holding) {
            drop(*slowest);
        } else {
            slowest->link.abandon();
            activate(*slowest);
        }
    }
}

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
    if (state == Arrival::State::nothing)
        enter(client, Phase::idle, Clock::now(), options_.keepAlive);
    else
        enter(client, Phase::receiving, client.arrival.since(),
              state == Arrival::State::head ? timeouts.head : timeouts.body);
}

void Listener::activate(Client& client) {
    count(client);
    {
        const std::lock_guard lock(mutex_);
        client.phase = Phase::active;
        queue_.push_back(&client);
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

// The next request of a client that asks one after the other comes within a moment: taking it here
// saves two wake-ups. Nobody must wait for this thread meanwhile.
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
        client.answered = connection.answer(client.link, std::move(incoming), stopping_);
        count(client);
    }
}

}  // namespace farol::server::http
