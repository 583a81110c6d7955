#pragma once

#include <chrono>
#include <string>

namespace farol::server::http {

struct Health {
    bool ready = false;
    std::string reason;  ///< the answer's first line, or why there is none
};

/// Asks GET /readyz of the service at `url` ("http://host:port"). Does not throw for a service
/// that is not there or not ready; throws Error option.range if `url` is no http URL.
Health askHealth(const std::string& url, std::chrono::milliseconds patience);

}  // namespace farol::server::http
