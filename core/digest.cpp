#include "core/digest.h"

#include <blake2.h>

#include <array>
#include <cstdint>

namespace farol {

std::string contentDigest(std::string_view bytes) {
    std::array<std::uint8_t, 16> digest{};
    // Cannot fail: the sizes are within RFC 7693's, and there is no key.
    blake2b(digest.data(), bytes.data(), nullptr, digest.size(), bytes.size(), 0);
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t byte : digest) {
        text += kDigits[byte >> 4];
        text += kDigits[byte & 15];
    }
    return text;
}

}  // namespace farol
