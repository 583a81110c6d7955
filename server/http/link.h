#pragma once

#include <string>
#include <string_view>

namespace farol::server::http {

/// A connected, non-blocking socket with its receive and send buffers. No call ever blocks. Does
/// not own the socket. Used by one thread at a time.
class Link {
  public:
    explicit Link(int fd) : fd_(fd) {}
    int fd() const { return fd_; }

    enum class Got { bytes, nothing, closed };
    /// Appends some of the available bytes to in().
    Got receive();
    /// Whether the other side has ended its sending or the connection, and nothing it sent is left.
    /// Changes nothing.
    bool isAtEnd() const;
    /// Bytes that have arrived and are not consumed yet.
    std::string& in() { return in_; }

    /// Sends `bytes` after the pending ones: large pieces at once as far as the socket accepts
    /// them, the rest by flush().
    void put(std::string_view bytes);
    void flush();
    /// Nothing is sent until release().
    void hold() { held_ = true; }
    void release() { held_ = false; }
    bool isHeld() const { return held_; }
    /// Drops the pending bytes: they are not sent any more.
    void abandon();
    bool isPending() const { return sent_ < out_.size(); }
    bool isBroken() const { return broken_; }

    /// Shuts down the sending side (RFC 9112 section 9.6).
    void endSending();
    /// Bytes of memory that wait for the client.
    std::size_t held() const { return in_.size() + out_.size() - sent_; }

  private:
    /// Sends the pending bytes, then `more`; returns the number of bytes of `more` that were sent.
    std::size_t push(std::string_view more);

    int fd_;
    std::string in_, out_;
    std::size_t sent_ = 0;  ///< of out_
    bool broken_ = false, held_ = false;
};

}  // namespace farol::server::http
