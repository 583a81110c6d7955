#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace farol::server::http {

/// Host and port of RFC 3986, section 3.2, without user information.
struct Authority {
    std::string host;  ///< lower case, without a final dot; an IPv6 address in its shortest form
    std::optional<int> port;

    bool operator==(const Authority&) const = default;
};

/// Parses "name", "name:80", "192.0.2.1" or "[2001:db8::1]:80". Nothing for anything else.
std::optional<Authority> parseAuthority(std::string_view text);

/// Returns the client of an address: an IPv4 address, or the first 64 bits of an IPv6 address,
/// since one client usually has the whole /64.
std::string clientOfAddress(const std::string& address);

}  // namespace farol::server::http
