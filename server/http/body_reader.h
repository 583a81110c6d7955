#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace farol::server::http {

/// The body of one request, put together from its bytes as they arrive: by its length or in chunks
/// (RFC 9112 sections 6 and 7.1). Strict, because a body whose end two programs see in different
/// places hides a request: a chunk is hexadecimal digits, an extension or none, CRLF, its bytes
/// and CRLF; there are no trailers. Never waits, never throws.
class BodyReader {
  public:
    enum class State {
        more,
        whole,
        tooLarge,  ///< more than `maxBytes` are there or announced; no more is read
        noMemory,  ///< there was none for it; its bytes are freed and no more are read
        broken     ///< not a body, or it will not become whole
    };

    /// `length` or nothing for chunks.
    BodyReader(std::optional<std::uint64_t> length, std::size_t maxBytes);

    /// Appends the part of `bytes` that belongs to the body; returns its length.
    std::size_t feed(std::string_view bytes);
    void giveUp();
    State state() const { return state_; }
    std::string take() { return std::move(body_); }
    std::size_t size() const { return body_.size(); }

  private:
    enum class Part { data, dataEnd, sizeLine, end };

    void read(std::string_view bytes, std::size_t& at);
    void append(std::string_view bytes);
    void lineDone();

    std::string body_, line_;
    std::size_t maxBytes_;
    std::size_t extensions_ = 0;  ///< bytes of size lines beyond a size
    bool chunked_;
    std::uint64_t left_ = 0;  ///< of the chunk, or of the body
    Part part_;
    State state_ = State::more;
};

}  // namespace farol::server::http
