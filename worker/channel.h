#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace farol::worker {

using Clock = std::chrono::steady_clock;

/// One end of a socket pair that carries whole messages: eight bytes of length, then the bytes.
/// Owns the descriptor.
class Channel {
  public:
    enum class Result {
        done,
        closed,
        late,
        oversize,    ///< the message is longer than allowed; nothing of it was received
        interrupted  ///< the watch ended the wait
    };
    /// Asked every kLook while a call waits; true ends the wait.
    using Watch = std::function<bool()>;
    static constexpr std::chrono::milliseconds kLook{100};

    explicit Channel(int fd) : fd_(fd) {}
    Channel(Channel&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
    Channel& operator=(Channel&&) = delete;
    ~Channel();

    /// `closed`: the other end is gone, or the message is longer than kMaxBytes.
    Result send(std::string_view message, Clock::time_point deadline);
    Result receive(std::string& message, Clock::time_point deadline,
                   std::uint64_t maxBytes = kMaxBytes, const Watch& watch = nullptr);

    /// More than the largest body or image with its metadata.
    static constexpr std::uint64_t kMaxBytes = std::uint64_t{2} << 30U;

  private:
    Result wait(short events, Clock::time_point deadline, const Watch& watch = nullptr) const;
    Result readAll(char* to, std::size_t size, Clock::time_point deadline, const Watch& watch);
    Result writeAll(const char* from, std::size_t size, Clock::time_point deadline);
    int fd_;
};

}  // namespace farol::worker
