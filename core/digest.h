#pragma once

#include <string>
#include <string_view>

namespace farol {

/// Returns 32 hexadecimal digits that identify the content: BLAKE2b with 16 bytes (RFC 7693).
/// Collision-resistant, and so a safe key of caches that untrusted files share.
std::string contentDigest(std::string_view bytes);

}  // namespace farol
