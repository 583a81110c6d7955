#pragma once

#include <optional>
#include <string>
#include <vector>

#include "server/http/authority.h"
#include "server/http/message.h"

namespace farol::server {

/// Refuses requests that a page of another site makes a browser send: under a host name that is
/// not the service's (DNS rebinding), and requests that change something from another origin.
/// Requests of programs, which send neither Origin nor Sec-Fetch-Site, pass.
class SiteGuard {
  public:
    /// `allowedHosts`: "name" (any port) or "name:port"; empty, or "*" among them: any host.
    /// `corsOrigin`: an origin that may call, "*" for all, or empty. Throws Error option.range.
    SiteGuard(const std::vector<std::string>& allowedHosts, const std::string& corsOrigin);

    /// Throws Error http.host (no Host), http.host-unknown or http.cross-site.
    void check(const http::Request& request) const;

  private:
    struct Origin {
        std::string scheme;
        http::Authority authority;
        int port() const;
        bool operator==(const Origin& other) const;
    };
    static std::optional<Origin> parseOrigin(const std::string& text);
    static bool isSameOrigin(const Origin& origin, const http::Request& request);
    void checkHost(const http::Request& request) const;
    void checkSite(const http::Request& request) const;
    bool isNamed(const std::string& origin) const;

    std::vector<http::Authority> hosts_;  ///< empty: any
    std::string cors_;
};

}  // namespace farol::server
