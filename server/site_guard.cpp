#include "server/site_guard.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "core/text.h"
#include "server/messages.h"

namespace farol::server {
namespace {

// Health checks of orchestrators and proxies use addresses that the service does not know.
bool isProbe(const http::Request& request) {
    return request.path == "/livez" || request.path == "/readyz";
}

int defaultPort(const std::string& scheme) {
    return scheme == "https" ? 443 : scheme == "http" ? 80 : 0;
}

}  // namespace

int SiteGuard::Origin::port() const { return authority.port.value_or(defaultPort(scheme)); }

bool SiteGuard::Origin::operator==(const Origin& other) const {
    return scheme == other.scheme && authority.host == other.authority.host &&
           port() == other.port();
}

SiteGuard::SiteGuard(const std::vector<std::string>& allowedHosts, const std::string& corsOrigin)
    : cors_(corsOrigin) {
    for (const std::string& text : allowedHosts) {
        if (text == "*") continue;
        const auto host = http::parseAuthority(text);
        if (!host)
            throw Error(message<"option.range/allowed-hosts">("value"_arg = text), {},
                        "allowed-hosts");
        hosts_.push_back(*host);
    }
    if (std::find(allowedHosts.begin(), allowedHosts.end(), "*") != allowedHosts.end())
        hosts_.clear();
    if (!cors_.empty() && cors_ != "*" && cors_ != "null" && !parseOrigin(cors_))
        throw Error(message<"option.range/cors">("value"_arg = cors_), {}, "cors");
}

// "scheme://host" or "scheme://host:port", RFC 6454 section 6.2.
std::optional<SiteGuard::Origin> SiteGuard::parseOrigin(const std::string& text) {
    const std::size_t end = text.find("://");
    if (end == std::string::npos || end == 0) return std::nullopt;
    const auto authority = http::parseAuthority(std::string_view(text).substr(end + 3));
    if (!authority) return std::nullopt;
    return Origin{lowerCase(text.substr(0, end)), *authority};
}

// A proxy that ends TLS leaves no trace of the scheme: a Host without a port has the origin's.
bool SiteGuard::isSameOrigin(const Origin& origin, const http::Request& request) {
    return request.authority && request.authority->host == origin.authority.host &&
           request.authority->port.value_or(defaultPort(origin.scheme)) == origin.port();
}

bool SiteGuard::isNamed(const std::string& origin) const {
    if (cors_.empty()) return false;
    if (cors_ == "*" || cors_ == origin) return true;
    const auto named = parseOrigin(cors_), asking = parseOrigin(origin);
    return named && asking && *named == *asking;
}

void SiteGuard::check(const http::Request& request) const {
    if (!isProbe(request)) checkHost(request);
    if (request.method != "GET" && request.method != "OPTIONS") checkSite(request);
}

void SiteGuard::checkHost(const http::Request& request) const {
    if (request.lacksHost) throw Error(message<"http.host">());
    // HTTP/1.0 has no Host, and no browser uses it.
    if (hosts_.empty() || !request.authority) return;
    const http::Authority& asked = *request.authority;
    const bool isKnown =
        std::any_of(hosts_.begin(), hosts_.end(), [&](const http::Authority& host) {
            return host.host == asked.host && (!host.port || host.port == asked.port);
        });
    if (!isKnown) throw Error(message<"http.host-unknown">("host"_arg = asked.host));
}

void SiteGuard::checkSite(const http::Request& request) const {
    bool hasForeignOrigin = false, hasNamedOrigin = cors_ == "*", isFromOtherSite = false;
    for (const auto& [name, value] : request.headers) {
        if (name == "origin") {
            const auto origin = parseOrigin(value);
            if (isNamed(value))
                hasNamedOrigin = true;
            else if (!origin || !isSameOrigin(*origin, request))
                hasForeignOrigin = true;
        } else if (name == "sec-fetch-site" && value != "same-origin" && value != "none") {
            isFromOtherSite = true;
        }
    }
    if (hasForeignOrigin || (isFromOtherSite && !hasNamedOrigin))
        throw Error(message<"http.cross-site">());
}

}  // namespace farol::server
