#include "server/http/listener.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "server/http/head.h"

namespace farol::server::http {
namespace {

constexpr int kBacklog = 511;
constexpr int kSweepMs = 500;
constexpr int kNextMs = 2;

std::string errnoText(int code) { return std::generic_category().message(code); }

int bindTo(const std::string& host, int port) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
    addrinfo* found = nullptr;
    const std::string at = host + ":" + std::to_string(port);
    const int fault = ::getaddrinfo(host.empty() ? nullptr : host.c_str(),
                                    std::to_string(port).c_str(), &hints, &found);
    if (fault != 0)
        throw std::runtime_error("cannot listen on " + at + ": " + ::gai_strerror(fault));
    const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(found, ::freeaddrinfo);
    int lastError = EADDRNOTAVAIL;
    for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
        const int fd = ::socket(one->ai_family, one->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC,
                                one->ai_protocol);
        if (fd < 0) {
            lastError = errno;
            continue;
        }
        const int yes = 1;
        // Not SO_REUSEPORT, the library's own choice: a second server would share the port in
        // silence.
        ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
        if (::bind(fd, one->ai_addr, one->ai_addrlen) == 0 && ::listen(fd, kBacklog) == 0)
            return fd;
        lastError = errno;
        ::close(fd);
    }
    throw std::runtime_error("cannot listen on " + at + ": " + errnoText(lastError));
}

int portOf(int fd) {
    sockaddr_storage address{};
    socklen_t size = sizeof address;
    ::getsockname(fd, reinterpret_cast<sockaddr*>(&address), &size);
    if (address.ss_family == AF_INET6)
        return ntohs(reinterpret_cast<const sockaddr_in6*>(&address)->sin6_port);
    return ntohs(reinterpret_cast<const sockaddr_in*>(&address)->sin_port);
}

std::string addressText(const sockaddr_storage& address) {
    std::array<char, INET6_ADDRSTRLEN> text{};
    const void* source =
        address.ss_family == AF_INET6
            ? static_cast<const void*>(&reinterpret_cast<const sockaddr_in6*>(&address)->sin6_addr)
            : static_cast<const void*>(&reinterpret_cast<const sockaddr_in*>(&address)->sin_addr);
    if (::inet_ntop(address.ss_family, source, text.data(), text.size()) == nullptr) return "";
    return text.data();
}

}  // namespace

Listener::Listener(const ListenOptions& options, Handler& handler)
    : options_(options), handler_(handler) {
    listenFd_ = bindTo(options.host, options.port);
    port_ = portOf(listenFd_);
    epollFd_ = ::epoll_create1(EPOLL_CLOEXEC);
    wakeFd_ = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    if (epollFd_ < 0 || wakeFd_ < 0) {
        const int fault = errno;
        for (const int fd : {listenFd_, epollFd_, wakeFd_})
            if (fd >= 0) ::close(fd);
        throw std::runtime_error("cannot watch sockets: " + errnoText(fault));
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
    acceptor_ = std::thread([this] { acceptLoop(); });
}

void Listener::stop() {
    stopping_ = true;
    const std::uint64_t one = 1;
    if (::write(wakeFd_, &one, sizeof one) < 0 && errno != EAGAIN) return;
    if (acceptor_.joinable()) acceptor_.join();
    {
        const std::lock_guard lock(mutex_);
        ended_ = true;
    }
    ready_.notify_all();
    for (std::thread& thread : threads_) thread.join();
    threads_.clear();
    dropAll();
}

void Listener::acceptLoop() {
    std::array<epoll_event, 64> events;
    while (!stopping_) {
        const int count =
            ::epoll_wait(epollFd_, events.data(), static_cast<int>(events.size()), kSweepMs);
        for (int i = 0; i < count; ++i) {
            const int fd = events[static_cast<std::size_t>(i)].data.fd;
            if (fd == listenFd_)
                acceptAll();
            else if (fd != wakeFd_)
                look(fd, (events[static_cast<std::size_t>(i)].events & ~EPOLLIN) != 0);
        }
        sweep();
    }
    // From here on clients are refused by the kernel and may try elsewhere.
    ::close(listenFd_);
    listenFd_ = -1;
}

void Listener::acceptAll() {
    for (;;) {
        sockaddr_storage address{};
        socklen_t size = sizeof address;
        const int fd = ::accept4(listenFd_, reinterpret_cast<sockaddr*>(&address), &size,
                                 SOCK_NONBLOCK | SOCK_CLOEXEC);
        if (fd < 0) {
            if (errno == EINTR || errno == ECONNABORTED) continue;
            // Out of descriptors: those in use must come back first; do not spin on the event.
            if (errno != EAGAIN) std::this_thread::sleep_for(std::chrono::milliseconds(10));
            return;
        }
        const int yes = 1;
        ::setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
        bool full = false;
        {
            const std::lock_guard lock(mutex_);
            full = clients_.size() >= static_cast<std::size_t>(options_.maxConnections);
            if (!full) clients_[fd] = {addressText(address), Clock::now()};
        }
        if (full) {
            static constexpr std::string_view kFull =
                "HTTP/1.1 503 Service Unavailable\r\nRetry-After: 1\r\nConnection: close\r\n"
                "Content-Length: 0\r\n\r\n";
            (void)::send(fd, kFull.data(), kFull.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
            ::close(fd);
            continue;
        }
        epoll_event event{};
        event.events = EPOLLIN | EPOLLRDHUP | EPOLLONESHOT;
        event.data.fd = fd;
        if (::epoll_ctl(epollFd_, EPOLL_CTL_ADD, fd, &event) != 0) drop(fd);
    }
}

// A thread is worth spending on a connection once a whole head is there (or too much of one, or
// the end). Until then the kernel is told to wake us for more bytes than there are now.
void Listener::look(int fd, bool ended) {
    std::array<char, kMaxHead> bytes;
    const ssize_t got = ::recv(fd, bytes.data(), bytes.size(), MSG_PEEK | MSG_DONTWAIT);
    const std::string_view text(bytes.data(), got > 0 ? static_cast<std::size_t>(got) : 0);
    const bool partial = !ended && got > 0 && text.size() < bytes.size() &&
                         text.find("\r\n\r\n") == std::string_view::npos;
    bool wait = partial || (!ended && got < 0 && errno == EAGAIN);
    {
        const std::lock_guard lock(mutex_);
        const auto found = clients_.find(fd);
        if (found == clients_.end() || found->second.active) return;
        Client& client = found->second;
        const int low = static_cast<int>(got) + 1;
        if (partial && client.headSince == Clock::time_point{}) client.headSince = Clock::now();
        if (partial && ::setsockopt(fd, SOL_SOCKET, SO_RCVLOWAT, &low, sizeof low) != 0)
            wait = false;
    }
    if (wait)
        watch(fd);
    else
        activate(fd);
}

void Listener::watch(int fd) {
    epoll_event event{};
    event.events = EPOLLIN | EPOLLRDHUP | EPOLLONESHOT;
    event.data.fd = fd;
    ::epoll_ctl(epollFd_, EPOLL_CTL_MOD, fd, &event);
}

void Listener::activate(int fd) {
    {
        const std::lock_guard lock(mutex_);
        const auto found = clients_.find(fd);
        if (found == clients_.end() || found->second.active) return;
        if (found->second.headSince != Clock::time_point{}) {
            const int one = 1;
            ::setsockopt(fd, SOL_SOCKET, SO_RCVLOWAT, &one, sizeof one);
        }
        found->second.active = true;
        queue_.push_back(fd);
    }
    ready_.notify_one();
}

void Listener::park(int fd) {
    const std::lock_guard lock(mutex_);
    Client& client = clients_[fd];
    client.active = false;
    client.headSince = {};
    client.idleSince = Clock::now();
    watch(fd);
}

void Listener::drop(int fd) {
    {
        const std::lock_guard lock(mutex_);
        clients_.erase(fd);
    }
    ::close(fd);
}

void Listener::sweep() {
    std::vector<int> late;
    {
        const std::lock_guard lock(mutex_);
        const auto now = Clock::now();
        for (auto it = clients_.begin(); it != clients_.end();) {
            const Client& client = it->second;
            const bool begun = client.headSince != Clock::time_point{};
            if (!client.active && begun && now - client.headSince > options_.timeouts.head)
                late.push_back(it->first);
            if (!client.active && !begun && now - client.idleSince > options_.keepAlive) {
                ::close(it->first);
                it = clients_.erase(it);
            } else {
                ++it;
            }
        }
    }
    for (const int fd : late) activate(fd);  // to be told that it was too slow
}

void Listener::dropAll() {
    const std::lock_guard lock(mutex_);
    for (const auto& [fd, client] : clients_) ::close(fd);
    clients_.clear();
}

// The next request of a client that asks one after the other comes within a moment: taking it here
// saves two wake-ups. Nobody must wait for this thread meanwhile, and the head must be whole.
bool Listener::nextIsHere(int fd) {
    {
        const std::lock_guard lock(mutex_);
        if (!queue_.empty()) return false;
    }
    pollfd wait{fd, POLLIN, 0};
    if (::poll(&wait, 1, kNextMs) != 1 || wait.revents != POLLIN) return false;
    std::array<char, kMaxHead> bytes;
    const ssize_t got = ::recv(fd, bytes.data(), bytes.size(), MSG_PEEK | MSG_DONTWAIT);
    return got > 0 &&
           std::string_view(bytes.data(), static_cast<std::size_t>(got)).find("\r\n\r\n") !=
               std::string_view::npos;
}

void Listener::serveLoop() {
    Connection connection(handler_, options_.timeouts);
    for (;;) {
        int fd = -1;
        std::string remoteAddress;
        {
            std::unique_lock lock(mutex_);
            ready_.wait(lock, [this] { return !queue_.empty() || ended_; });
            if (queue_.empty()) return;
            fd = queue_.front();
            queue_.pop_front();
            remoteAddress = clients_[fd].remoteAddress;
        }
        bool keep = true;
        do {
            keep = connection.serve(fd, remoteAddress, [this] { return stopping_.load(); });
        } while (keep && !stopping_ && nextIsHere(fd));
        if (keep && !stopping_)
            park(fd);
        else
            drop(fd);
    }
}

}  // namespace farol::server::http
