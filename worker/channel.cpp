#include "worker/channel.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace farol::worker {

Channel::~Channel() {
    if (fd_ >= 0) close(fd_);
}

Channel::Result Channel::wait(short events, Clock::time_point deadline, const Watch& watch) const {
    for (;;) {
        int ms = -1;
        if (deadline != Clock::time_point::max()) {
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
            if (left.count() <= 0) return Result::late;
            ms = static_cast<int>(std::min<std::int64_t>(left.count(), 60'000));
        }
        if (watch) {
            if (watch()) return Result::interrupted;
            const auto look = static_cast<int>(kLook.count());
            ms = ms < 0 ? look : std::min(ms, look);
        }
        pollfd one{fd_, events, 0};
        const int ready = poll(&one, 1, ms);
        if (ready > 0) return Result::done;
        if (ready < 0 && errno != EINTR) return Result::closed;
    }
}

Channel::Result Channel::readAll(char* to, std::size_t size, Clock::time_point deadline,
                                 const Watch& watch) {
    while (size > 0) {
        const ssize_t got = recv(fd_, to, size, MSG_DONTWAIT);
        if (got == 0) return Result::closed;
        if (got < 0) {
            if (errno == EINTR) continue;
            if (errno != EAGAIN) return Result::closed;
            if (const Result waited = wait(POLLIN, deadline, watch); waited != Result::done)
                return waited;
            continue;
        }
        to += got;
        size -= static_cast<std::size_t>(got);
    }
    return Result::done;
}

Channel::Result Channel::writeAll(const char* from, std::size_t size, Clock::time_point deadline) {
    while (size > 0) {
        const ssize_t sent = ::send(fd_, from, size, MSG_DONTWAIT | MSG_NOSIGNAL);
        if (sent < 0) {
            if (errno == EINTR) continue;
            if (errno != EAGAIN) return Result::closed;
            if (const Result waited = wait(POLLOUT, deadline); waited != Result::done)
                return waited;
            continue;
        }
        from += sent;
        size -= static_cast<std::size_t>(sent);
    }
    return Result::done;
}

Channel::Result Channel::send(std::string_view message, Clock::time_point deadline) {
    const std::uint64_t size = message.size();
    if (size > kMaxBytes) return Result::closed;
    const Result head = writeAll(reinterpret_cast<const char*>(&size), sizeof size, deadline);
    return head == Result::done ? writeAll(message.data(), message.size(), deadline) : head;
}

Channel::Result Channel::receive(std::string& message, Clock::time_point deadline,
                                 std::uint64_t maxBytes, const Watch& watch) {
    std::uint64_t size = 0;
    if (const Result head = readAll(reinterpret_cast<char*>(&size), sizeof size, deadline, watch);
        head != Result::done)
        return head;
    if (size > maxBytes) return Result::oversize;
    // Allocates as bytes arrive: an announced length alone takes no memory.
    constexpr std::size_t kStep = std::size_t{16} << 20U;
    message.clear();
    while (message.size() < size) {
        const std::size_t before = message.size();
        const std::size_t step = std::min<std::size_t>(kStep, size - before);
        message.resize(before + step);
        if (const Result part = readAll(message.data() + before, step, deadline, watch);
            part != Result::done)
            return part;
    }
    return Result::done;
}

}  // namespace farol::worker
