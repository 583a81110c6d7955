#include "server/http/authority.h"

#include <arpa/inet.h>

#include <algorithm>
#include <array>

#include "core/number.h"
#include "core/text.h"

namespace farol::server::http {
namespace {

using Bytes6 = std::array<unsigned char, 16>;

constexpr std::size_t kMaxAuthority = 300;

std::string textOf(const Bytes6& bytes) {
    std::array<char, INET6_ADDRSTRLEN> text{};
    ::inet_ntop(AF_INET6, bytes.data(), text.data(), text.size());
    return text.data();
}

bool isNameCharacter(char c) {
    return isAlphanumeric(c) ||
           std::string_view("-._~%!$&'()*+,;=").find(c) != std::string_view::npos;
}

std::optional<int> parsePort(std::string_view text) {
    const auto port = parseExact<int>(text);
    return port && *port >= 0 && *port <= 65'535 ? port : std::nullopt;
}

}  // namespace

std::optional<Authority> parseAuthority(std::string_view text) {
    if (text.empty() || text.size() > kMaxAuthority) return std::nullopt;
    Authority out;
    std::string_view port;
    if (text.front() == '[') {
        const std::size_t end = text.find(']');
        if (end == std::string_view::npos) return std::nullopt;
        Bytes6 bytes{};
        if (::inet_pton(AF_INET6, std::string(text.substr(1, end - 1)).c_str(), bytes.data()) != 1)
            return std::nullopt;
        out.host = textOf(bytes);
        port = text.substr(end + 1);
    } else {
        const std::size_t colon = text.find(':');
        out.host = lowerCase(text.substr(0, colon));
        if (out.host.ends_with('.')) out.host.pop_back();
        if (out.host.empty() || !std::all_of(out.host.begin(), out.host.end(), isNameCharacter))
            return std::nullopt;
        if (colon != std::string_view::npos) port = text.substr(colon);
    }
    if (port.empty() || port == ":") return out;  // an empty port is the scheme's
    if (port.front() != ':') return std::nullopt;
    out.port = parsePort(port.substr(1));
    return out.port ? std::optional(out) : std::nullopt;
}

std::string clientOfAddress(const std::string& address) {
    Bytes6 bytes{};
    if (::inet_pton(AF_INET6, address.c_str(), bytes.data()) != 1) return address;
    // ::ffff:a.b.c.d is an IPv4 client on a socket for both.
    static constexpr std::array<unsigned char, 12> kMapped = {0, 0, 0, 0, 0,    0,
                                                              0, 0, 0, 0, 0xFF, 0xFF};
    if (!std::equal(kMapped.begin(), kMapped.end(), bytes.begin()))
        std::fill(bytes.begin() + 8, bytes.end(), static_cast<unsigned char>(0));
    return textOf(bytes);
}

}  // namespace farol::server::http
