#include "server/http/listener.h"

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <new>
#include <stdexcept>
#include <system_error>

#include "server/http/socket.h"

namespace farol::server::http {
namespace {

constexpr int kLookMs = 250;
constexpr std::chrono::milliseconds kSweep{100};
// Reads of one connection before others have their turn, and of all that have bytes at once: a
// quarter of a megabyte and one.
constexpr int kReads = 4, kReadsOfAll = 16;
constexpr std::size_t kLingerBytes = std::size_t{64} << 20U;

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
    closing_ = true;
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
    networks_.clear();
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
        reads_ = std::clamp(kReadsOfAll / std::max(count, 1), 1, kReads);
        for (int i = 0; i < count; ++i) {
            const int fd = events[static_cast<std::size_t>(i)].data.fd;
            if (fd == wakeFd_) {
                std::uint64_t times = 0;
                if (::read(wakeFd_, &times, sizeof times) < 0) continue;
            } else if (fd == listenFd_) {
                acceptSome();
            } else {
                look(fd);
            }
        }
        sweep();
        relieve();
        if (!isAccepting_ && Clock::now() >= acceptAgain_) accept(true);
        if (stopping_ && listenFd_ >= 0) {
            // From here on clients are refused by the kernel and may try elsewhere. Those that it
            // has connected already are served.
            acceptSome();
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
    for (Client* client : idle) {
        // A request that has arrived but was not read yet is answered.
        if (client->phase == Phase::idle && client->link.receive() == Link::Got::bytes)
            client->arrival.feed(client->link.in());
        client->arrival.state() == Arrival::State::whole ? activate(*client) : drop(*client);
    }
    const std::lock_guard lock(mutex_);
    return clients_.empty() || Clock::now() - stoppedAt > options_.timeouts.grace;
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
    try {
        move(*client, phase);
    } catch (const std::bad_alloc&) {
        {
            const std::lock_guard lock(mutex_);
            ++closed_.memory;
        }
        drop(*client);
    }
}

void Listener::move(Client& client, Phase phase) {
    if (phase == Phase::lingering) return linger(client);
    if (phase == Phase::holding) return giveUp(client, Phase::sending);  // it went away
    client.link.flush();
    count(client);
    if (phase != Phase::sending) return receive(client);
    if (client.link.isPending())
        watch(client);
    else
        activate(client);
}

void Listener::receive(Client& client) {
    for (int i = 0; i < reads_; ++i) {
        const Link::Got got = client.link.receive();
        if (got == Link::Got::nothing) break;
        if (got == Link::Got::closed) {
            if (client.arrival.state() != Arrival::State::body) return drop(client);
            client.arrival.giveUp(client.link.in());  // it may still read the response
            return activate(client);
        }
        client.arrival.feed(client.link.in());
        if (client.arrival.state() == Arrival::State::whole) return activate(client);
    }
    await(client);
}

// Reads the client's remaining bytes for a moment: it then sees the response instead of a
// reset (RFC 9112 section 9.6).
void Listener::linger(Client& client) {
    for (int i = 0; i < reads_; ++i) {
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

// Ends the connection of a client that is too slow; a thread then sends 408 or logs it.
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

}  // namespace farol::server::http
