#include "server/http/socket.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace farol::server::http {
namespace {

constexpr int kBacklog = 511;

std::string errnoText(int code) { return std::generic_category().message(code); }

std::string addressText(const sockaddr_storage& address) {
    std::array<char, INET6_ADDRSTRLEN> text{};
    const void* source =
        address.ss_family == AF_INET6
            ? static_cast<const void*>(&reinterpret_cast<const sockaddr_in6*>(&address)->sin6_addr)
            : static_cast<const void*>(&reinterpret_cast<const sockaddr_in*>(&address)->sin_addr);
    if (::inet_ntop(address.ss_family, source, text.data(), text.size()) == nullptr) return "";
    return text.data();
}

using Addresses = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;

Addresses resolve(const std::string& host, int port, int& fault) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
    addrinfo* found = nullptr;
    fault = ::getaddrinfo(host.empty() ? nullptr : host.c_str(), std::to_string(port).c_str(),
                          &hints, &found);
    return {found, [](addrinfo* list) {
                if (list != nullptr) ::freeaddrinfo(list);
            }};
}

bool isLoopbackAddress(const sockaddr* address) {
    if (address->sa_family == AF_INET) {
        const auto* v4 = reinterpret_cast<const sockaddr_in*>(address);
        return ntohl(v4->sin_addr.s_addr) >> 24U == IN_LOOPBACKNET;
    }
    return address->sa_family == AF_INET6 &&
           IN6_IS_ADDR_LOOPBACK(&reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr);
}

}  // namespace

bool isLoopback(const std::string& host) {
    int fault = 0;
    const Addresses addresses = resolve(host, 0, fault);
    for (const addrinfo* one = addresses.get(); one != nullptr; one = one->ai_next)
        if (!isLoopbackAddress(one->ai_addr)) return false;
    return addresses != nullptr;
}

int listenOn(const std::string& host, int port) {
    const std::string at = host + ":" + std::to_string(port);
    int fault = 0;
    const Addresses addresses = resolve(host, port, fault);
    if (fault != 0)
        throw std::runtime_error("cannot listen on " + at + ": " + ::gai_strerror(fault));
    int lastError = EADDRNOTAVAIL;
    for (const addrinfo* one = addresses.get(); one != nullptr; one = one->ai_next) {
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

int acceptFrom(int fd, std::string& address) {
    sockaddr_storage peer{};
    socklen_t size = sizeof peer;
    const int client =
        ::accept4(fd, reinterpret_cast<sockaddr*>(&peer), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (client < 0) return client;
    const int yes = 1;
    ::setsockopt(client, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    address = addressText(peer);
    return client;
}

}  // namespace farol::server::http
