#include "server/secret.h"

#include <sys/random.h>

#include <array>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "core/digest.h"

namespace farol::server {

std::string randomSecret() {
    constexpr std::string_view kLetters = "abcdefghijkmnpqrstuvwxyz234567";
    constexpr std::size_t kLength = 24;
    // Values above this multiple of the letters' number are skipped: all letters are as likely.
    constexpr std::size_t kEven = 256 / kLetters.size() * kLetters.size();
    std::string out;
    while (out.size() < kLength) {
        std::array<unsigned char, 64> bytes{};
        const ssize_t got = getrandom(bytes.data(), bytes.size(), 0);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) throw std::system_error(errno, std::generic_category(), "getrandom");
        for (std::size_t i = 0; i < static_cast<std::size_t>(got) && out.size() < kLength; ++i)
            if (bytes[i] < kEven) out += kLetters[bytes[i] % kLetters.size()];
    }
    return out;
}

bool isSameSecret(const std::string& a, const std::string& b) {
    return contentDigest(a) == contentDigest(b);
}

}  // namespace farol::server
