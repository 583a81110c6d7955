#pragma once

#include <string>
#include <string_view>

namespace farol {

/// 32 hexadecimal digits that name the content: BLAKE2b with 16 bytes (RFC 7693). Nobody can
/// make two files of the same name, and may therefore key caches that untrusted files share.
std::string contentDigest(std::string_view bytes);

}  // namespace farol
