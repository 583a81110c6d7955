#include "server/http/link.h"

#include <sys/socket.h>
#include <sys/uio.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace farol::server::http {
namespace {
constexpr std::size_t kReadSize = 64 * 1024;
// Below, a copy costs less than a call of the kernel: a head travels with the body behind it.
constexpr std::size_t kSmall = 8 * 1024;
}  // namespace

Link::Got Link::receive() {
    std::array<char, kReadSize> bytes;
    for (;;) {
        const ssize_t got = ::recv(fd_, bytes.data(), bytes.size(), 0);
        if (got > 0) {
            in_.append(bytes.data(), static_cast<std::size_t>(got));
            return Got::bytes;
        }
        if (got < 0 && errno == EINTR) continue;
        return got < 0 && errno == EAGAIN ? Got::nothing : Got::closed;
    }
}

bool Link::isAtEnd() const {
    char next = 0;
    const ssize_t got = ::recv(fd_, &next, 1, MSG_PEEK | MSG_DONTWAIT);
    return got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR);
}

std::size_t Link::push(std::string_view more) {
    if (held_) return 0;
    std::size_t taken = 0;
    while (!broken_ && (isPending() || taken < more.size())) {
        // The const_cast is safe: sendmsg() only reads these buffers.
        std::array<iovec, 2> parts{
            iovec{out_.data() + sent_, out_.size() - sent_},
            iovec{const_cast<char*>(more.data()) + taken, more.size() - taken}};
        msghdr message{};
        message.msg_iov = parts.data();
        message.msg_iovlen = parts.size();
        const ssize_t sent = ::sendmsg(fd_, &message, MSG_NOSIGNAL);
        if (sent < 0) {
            if (errno == EINTR) continue;
            if (errno != EAGAIN) abandon();
            break;
        }
        const std::size_t old = std::min(static_cast<std::size_t>(sent), out_.size() - sent_);
        sent_ += old;
        taken += static_cast<std::size_t>(sent) - old;
    }
    if (!isPending()) {
        out_.capacity() > kReadSize ? std::string().swap(out_) : out_.clear();
        sent_ = 0;
    }
    return taken;
}

void Link::put(std::string_view bytes) {
    if (broken_) return;
    const std::size_t taken = bytes.size() < kSmall ? 0 : push(bytes);
    if (!broken_) out_.append(bytes.substr(taken));
}

void Link::flush() { push({}); }

void Link::abandon() {
    broken_ = true;
    std::string().swap(out_);
    sent_ = 0;
}

void Link::endSending() { ::shutdown(fd_, SHUT_WR); }

}  // namespace farol::server::http
