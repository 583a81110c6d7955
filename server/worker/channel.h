#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace farol::server::worker {

using Clock = std::chrono::steady_clock;

/// One end of a socket pair that carries whole messages: eight bytes of length, then the bytes.
/// Owns the descriptor.
class Channel {
  public:
    enum class Result { done, closed, late };

    explicit Channel(int fd) : fd_(fd) {}
    Channel(Channel&& other) noexcept : fd_(other.fd_) { other.fd_ = -1; }
    Channel& operator=(Channel&&) = delete;
    ~Channel();

    /// `closed`: the other end is gone, or the message is longer than kMaxBytes.
    Result send(std::string_view message, Clock::time_point deadline);
    Result receive(std::string& message, Clock::time_point deadline);

    /// More than a body or a picture at their largest, with what goes with them.
    static constexpr std::uint64_t kMaxBytes = std::uint64_t{2} << 30U;

  private:
    Result wait(short events, Clock::time_point deadline) const;
    Result readAll(char* to, std::size_t size, Clock::time_point deadline);
    Result writeAll(const char* from, std::size_t size, Clock::time_point deadline);
    int fd_;
};

}  // namespace farol::server::worker
