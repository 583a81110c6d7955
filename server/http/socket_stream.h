#pragma once

#include <httplib.h>

#include <chrono>
#include <string>

namespace farol::server::http {

using Clock = std::chrono::steady_clock;

/// A connected, non-blocking socket with a deadline for everything read and one for everything
/// written, so that a client that trickles bytes cannot hold a thread. Does not own the socket.
class SocketStream final : public httplib::Stream {
  public:
    explicit SocketStream(int fd) : fd_(fd) {}

    enum class HeadResult { complete, closed, timedOut, tooLarge };
    /// Reads up to and with the blank line that ends a request's head.
    HeadResult readHead(std::size_t maxBytes, Clock::time_point deadline, std::string& head);

    /// Bytes that the library reads before those of the socket: the cleaned head.
    void prepend(std::string bytes);
    void setReadDeadline(Clock::time_point when) { readDeadline_ = when; }
    void setWriteDeadline(Clock::time_point when) { writeDeadline_ = when; }
    bool hasBuffered() const { return taken_ < buffer_.size(); }

    /// Says that nothing more will be sent, then takes what is still coming for a moment, so
    /// that the client reads the answer instead of a reset (RFC 9112 section 9.6).
    void finish(std::size_t maxBytes, Clock::time_point deadline);

    bool is_readable() const override;
    bool is_writable() const override;
    ssize_t read(char* target, size_t size) override;
    ssize_t write(const char* source, size_t size) override;
    void get_remote_ip_and_port(std::string& ip, int& port) const override;
    void get_local_ip_and_port(std::string& ip, int& port) const override;
    /// Only compared with FD_SETSIZE by the library, which matters to select() and not to us.
    socket_t socket() const override { return 0; }

    // Newer releases of the library ask for these; in older ones they override nothing.
    bool wait_readable() const { return is_readable(); }
    bool wait_writable() const { return is_writable(); }
    time_t duration() const { return 0; }

  private:
    bool waitFor(short events, Clock::time_point deadline) const;
    ssize_t receive(char* target, std::size_t size, Clock::time_point deadline);

    int fd_;
    std::string buffer_;
    std::size_t taken_ = 0;
    std::string prefix_;
    std::size_t prefixTaken_ = 0;
    Clock::time_point readDeadline_{}, writeDeadline_{};
    bool broken_ = false;
};

}  // namespace farol::server::http
