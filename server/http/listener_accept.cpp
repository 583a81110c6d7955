// Which connections have a place.
#include <poll.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <map>
#include <string_view>

#include "server/http/listener.h"
#include "server/http/socket.h"
#include "server/messages.h"

namespace farol::server::http {
namespace {

// Connections accepted before others have their turn.
constexpr int kAccepts = 16;
constexpr std::chrono::milliseconds kAcceptPause{100};
// A body is under way so long before its connection can be displaced.
constexpr std::chrono::seconds kSlowBody{1};

bool isOneWaiting(int listenFd) {
    pollfd wait{listenFd, POLLIN, 0};
    return ::poll(&wait, 1, 0) == 1;
}

// The response to a connection over the limit, whose request is not read.
std::string fullAnswer(Handler& handler) {
    Request unread;
    unread.id = newRequestId();
    Response full = handler.refuse(unread, 503, message<"busy.connections">());
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

bool Listener::Client::isWaiting() const {
    return phase == Phase::idle || phase == Phase::lingering ||
           (phase == Phase::receiving && arrival.state() == Arrival::State::head);
}

void Listener::acceptSome() {
    for (int i = 0; i < kAccepts; ++i) {
        std::string address;
        const int fd = acceptFrom(listenFd_, address);
        if (fd >= 0) {
            admit(fd, std::move(address));
        } else if (errno != EINTR && errno != ECONNABORTED) {
            // Out of descriptors or memory: accept() reports these even without a connection.
            if (errno == EAGAIN || !isOneWaiting(listenFd_)) return;
            if (!makeRoom("")) return accept(false);
        }
    }
}

void Listener::accept(bool isOn) {
    isAccepting_ = isOn;
    acceptAgain_ = Clock::now() + kAcceptPause;
    if (listenFd_ < 0) return;
    epoll_event event{};
    event.events = isOn ? EPOLLIN : 0U;
    event.data.fd = listenFd_;
    ::epoll_ctl(epollFd_, EPOLL_CTL_MOD, listenFd_, &event);
}

void Listener::admit(int fd, std::string address) {
    auto client = std::make_unique<Client>(fd, handler_, std::move(address));
    client->since = Clock::now();
    client->until = client->since + options_.keepAlive;
    const std::string network = client->network;
    const int perClient =
        options_.connectionsPerClient > 0 ? options_.connectionsPerClient : options_.maxConnections;
    const auto count = [&] {
        const std::lock_guard lock(mutex_);
        const auto found = networks_.find(network);
        return found == networks_.end() ? 0 : found->second;
    };
    const auto isFull = [&] {
        const std::lock_guard lock(mutex_);
        return clients_.size() >= static_cast<std::size_t>(options_.maxConnections);
    };
    if (count() >= perClient) {
        Client* own = displaceable(network);
        if (own == nullptr) return refuse(fd, closed_.clientFull);
        displace(*own);
    }
    if (isFull() && !makeRoom(network)) return refuse(fd, closed_.full);
    {
        const std::lock_guard lock(mutex_);
        clients_[fd] = std::move(client);
        ++networks_[network];
    }
    epoll_event event{};
    event.events = EPOLLIN | EPOLLRDHUP | EPOLLONESHOT;
    event.data.fd = fd;
    if (::epoll_ctl(epollFd_, EPOLL_CTL_ADD, fd, &event) == 0) return;
    Client* unwatched = nullptr;
    {
        const std::lock_guard lock(mutex_);
        unwatched = clients_[fd].get();
    }
    drop(*unwatched);
}

void Listener::refuse(int fd, long& counter) {
    {
        const std::lock_guard lock(mutex_);
        ++counter;
    }
    const std::string full = fullAnswer(handler_);
    (void)::send(fd, full.data(), full.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    ::close(fd);
}

void Listener::displace(Client& client) {
    {
        const std::lock_guard lock(mutex_);
        ++closed_.displaced;
    }
    drop(client);
}

/// Closes a connection for a newcomer from `network`: of the client with the most waiting ones its
/// oldest; where none waits, a slow body of a client with more connections than the newcomer.
bool Listener::makeRoom(const std::string& network) {
    std::string greediest;
    {
        const std::lock_guard lock(mutex_);
        std::map<std::string_view, int> waiting;
        for (const auto& [fd, client] : clients_)
            if (client->isWaiting()) ++waiting[client->network];
        const auto isLess = [](const auto& a, const auto& b) { return a.second < b.second; };
        if (!waiting.empty()) {
            greediest = std::max_element(waiting.begin(), waiting.end(), isLess)->first;
        } else if (!networks_.empty()) {
            const auto most = std::max_element(networks_.begin(), networks_.end(), isLess);
            const auto own = networks_.find(network);
            const int least = own == networks_.end() ? 2 : own->second + 2;
            if (most->first != network && most->second < least) return false;
            greediest = most->first;
        }
    }
    Client* client = displaceable(greediest);
    if (client == nullptr) return false;
    displace(*client);
    return true;
}

/// Returns the client's connection that has waited longest without any request, else the longest
/// waiting one, else its oldest slow body; null: none.
Listener::Client* Listener::displaceable(const std::string& network) const {
    const Clock::time_point slow = Clock::now() - kSlowBody;
    const std::lock_guard lock(mutex_);
    Client *silent = nullptr, *waiting = nullptr, *body = nullptr;
    const auto keepOlder = [](Client*& oldest, Client* client) {
        if (oldest == nullptr || client->since < oldest->since) oldest = client;
    };
    for (const auto& [fd, client] : clients_) {
        if (client->network != network) continue;
        if (client->isWaiting())
            keepOlder(client->hasAsked ? waiting : silent, client.get());
        else if (client->phase == Phase::receiving && client->since < slow)
            keepOlder(body, client.get());
    }
    if (silent != nullptr) return silent;
    return waiting != nullptr ? waiting : body;
}

}  // namespace farol::server::http
