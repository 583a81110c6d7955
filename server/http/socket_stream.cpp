#include "server/http/socket_stream.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace farol::server::http {
namespace {
constexpr std::size_t kReadSize = 16 * 1024;
}

bool SocketStream::waitFor(short events, Clock::time_point deadline) const {
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
        if (left.count() <= 0) return false;
        pollfd entry{fd_, events, 0};
        const int count = ::poll(&entry, 1, static_cast<int>(std::min<long>(left.count(), 60'000)));
        if (count > 0) return true;
        if (count < 0 && errno != EINTR) return false;
    }
}

ssize_t SocketStream::receive(char* target, std::size_t size, Clock::time_point deadline) {
    for (;;) {
        const ssize_t got = ::recv(fd_, target, size, 0);
        if (got >= 0) return got;
        if (errno == EINTR) continue;
        if (errno != EAGAIN) return -1;
        if (!waitFor(POLLIN, deadline)) {
            errno = ETIMEDOUT;
            return -1;
        }
    }
}

SocketStream::HeadResult SocketStream::readHead(std::size_t maxBytes, Clock::time_point deadline,
                                                std::string& head) {
    buffer_.erase(0, taken_);
    taken_ = 0;
    // A blank line or two before a request are allowed (RFC 9112 section 2.2).
    const auto skipBlank = [this] {
        while (buffer_.starts_with("\r\n")) buffer_.erase(0, 2);
    };
    skipBlank();
    std::size_t searched = 0;
    for (;;) {
        const std::size_t end = buffer_.find("\r\n\r\n", searched);
        if (end != std::string::npos && end + 4 <= maxBytes) {
            head = buffer_.substr(0, end + 4);
            taken_ = end + 4;
            return HeadResult::complete;
        }
        if (buffer_.size() >= maxBytes || end != std::string::npos) {
            head = buffer_;
            taken_ = buffer_.size();
            return HeadResult::tooLarge;
        }
        searched = buffer_.size() < 3 ? 0 : buffer_.size() - 3;
        std::array<char, kReadSize> chunk;
        const ssize_t got = receive(chunk.data(), chunk.size(), deadline);
        if (got == 0) return HeadResult::closed;
        if (got < 0)
            return errno == ETIMEDOUT && !buffer_.empty() ? HeadResult::timedOut
                                                          : HeadResult::closed;
        const bool first = buffer_.empty();
        buffer_.append(chunk.data(), static_cast<std::size_t>(got));
        if (first) skipBlank();
    }
}

void SocketStream::prepend(std::string bytes) {
    prefix_ = std::move(bytes);
    prefixTaken_ = 0;
}

void SocketStream::finish(std::size_t maxBytes, Clock::time_point deadline) {
    if (::shutdown(fd_, SHUT_WR) != 0) return;
    std::array<char, kReadSize> chunk;
    std::size_t total = 0;
    while (total < maxBytes) {
        const ssize_t got = receive(chunk.data(), chunk.size(), deadline);
        if (got <= 0) return;
        total += static_cast<std::size_t>(got);
    }
}

bool SocketStream::is_readable() const {
    return prefixTaken_ < prefix_.size() || hasBuffered() || waitFor(POLLIN, readDeadline_);
}

bool SocketStream::is_writable() const { return !broken_ && waitFor(POLLOUT, writeDeadline_); }

ssize_t SocketStream::read(char* target, size_t size) {
    const auto takeFrom = [&](const std::string& source, std::size_t& taken) {
        const std::size_t count = std::min(size, source.size() - taken);
        std::memcpy(target, source.data() + taken, count);
        taken += count;
        return static_cast<ssize_t>(count);
    };
    if (prefixTaken_ < prefix_.size()) return takeFrom(prefix_, prefixTaken_);
    if (hasBuffered()) return takeFrom(buffer_, taken_);
    // The library asks for single bytes in places: fill the buffer and serve from it.
    buffer_.resize(kReadSize);
    taken_ = 0;
    const ssize_t got = receive(buffer_.data(), buffer_.size(), readDeadline_);
    buffer_.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    if (got <= 0) return got;
    return takeFrom(buffer_, taken_);
}

ssize_t SocketStream::write(const char* source, size_t size) {
    while (!broken_) {
        const ssize_t sent = ::send(fd_, source, size, MSG_NOSIGNAL);
        if (sent >= 0) return sent;
        if (errno == EINTR) continue;
        if (errno == EAGAIN && waitFor(POLLOUT, writeDeadline_)) continue;
        broken_ = true;
    }
    return -1;
}

// The peer's address is taken from the socket when it is accepted, not here.
void SocketStream::get_remote_ip_and_port(std::string& ip, int& port) const {
    ip.clear();
    port = 0;
}

void SocketStream::get_local_ip_and_port(std::string& ip, int& port) const {
    ip.clear();
    port = 0;
}

}  // namespace farol::server::http
