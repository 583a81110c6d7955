#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/message.h"
#include "server/http/authority.h"

/// Requests and responses as the service sees them: nothing of the HTTP library shows here.
namespace farol::server::http {

using Fields = std::vector<std::pair<std::string, std::string>>;

/// Names and values for a line of the log.
using LogValue = std::variant<std::string, double, std::int64_t>;
using LogFields = std::vector<std::pair<std::string, LogValue>>;

struct Request {
    std::string id;             ///< the client's X-Request-Id when it is well-formed, else our own
    std::string method;         ///< upper case; HEAD arrives as GET (the body is dropped later)
    std::string path;           ///< as sent, still percent-encoded, without the query
    Fields query;               ///< decoded, in order of appearance
    Fields headers;             ///< names in lower case
    std::string remoteAddress;  ///< of the socket's peer, never from a header
    std::optional<Authority> authority;  ///< of an absolute target, else of Host
    bool lacksHost = false;              ///< HTTP/1.1 without a Host header
    /// Whether the client has closed its side of the connection and sent nothing more. To be called
    /// while the request is handled.
    std::function<bool()> isGone = [] { return false; };

    /// The header's value (name in lower case), or nothing.
    std::optional<std::string> header(std::string_view name) const;
};

/// The body of a request.
class Body {
  public:
    virtual ~Body() = default;
    /// All bytes. Throws Error limit.body when there are or were announced more than `maxBytes`,
    /// http.body when they did not arrive as announced. May be called once.
    virtual std::string read(std::size_t maxBytes) = 0;
};

struct Response {
    int status = 200;
    Fields headers;
    std::string body;
    std::shared_ptr<const std::string> shared = {};  ///< the body instead, where others send it too
    std::string contentType;
    LogFields logged;                   ///< more for this request's line in the log
    std::chrono::milliseconds hold{0};  ///< is sent that much later, and holds no thread

    void set(std::string name, std::string value) {
        headers.emplace_back(std::move(name), std::move(value));
    }
};

/// Handles the requests of all connections. Called by many threads at once; must not throw.
class Handler {
  public:
    virtual ~Handler() = default;
    /// Returns the most bytes of body to read before the request is handled; 0 if it will be
    /// refused with any body. Called by the one thread that moves all bytes: must not block.
    virtual std::size_t bodyLimit(const Request& request) const = 0;
    virtual Response handle(const Request& request, Body& body) = 0;
    /// The response to a request that could not be read as HTTP.
    virtual Response refuse(const Request& request, int status, const Message& message) = 0;
    /// Called after the response was written. `sent` is false if the client had disconnected or
    /// did not read it in time.
    virtual void finished(const Request& request, const Response& response, double milliseconds,
                          bool sent) = 0;
};

}  // namespace farol::server::http
