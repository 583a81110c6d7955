#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/message.h"
#include "server/http/message.h"

/// The head of a request (request line and header lines) is checked here before the library
/// parses it, because the library (cpp-httplib 0.11.4) is lenient where it must not be: lines
/// without bound, several or unreadable lengths, a Range header matched by a recursive regular
/// expression, client-sent REMOTE_ADDR headers, compressed bodies inflated without limit.
namespace farol::server::http {

inline constexpr std::size_t kMaxRequestLine = 8000;
inline constexpr std::size_t kMaxPath = 1024;
inline constexpr std::size_t kMaxHead = 32 * 1024;
inline constexpr std::size_t kMaxHeaderLines = 128;

/// A request that cannot be served, before any handler.
struct Refusal {
    int status;
    Message message;
};

struct Head {
    Request request;
    bool isHead = false;  ///< HEAD: answer without the body
    bool keepAlive = true;
    bool expectsContinue = false;
    bool chunked = false;
    std::optional<std::uint64_t> contentLength;
    std::optional<Refusal> refusal;  ///< set: do not parse any further
    std::string cleaned;             ///< the head that the library parses instead

    bool hasBody() const { return chunked || contentLength.value_or(0) > 0; }
    /// True if the method makes the library read a body.
    bool mayHaveBody() const;
    /// A head that was refused for want of a length (411) is treated as announcing an empty body.
    void takeAsEmpty();
};

/// `text` ends with the blank line. Never throws; faults are in `refusal`.
Head checkHead(std::string_view text);

}  // namespace farol::server::http
