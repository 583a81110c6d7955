#pragma once

#include <string>
#include <string_view>

namespace farol::scene {

/// 32 hexadecimal digits that name the content: BLAKE2b with 16 bytes (RFC 7693). Nobody can
/// make two files of the same name, so that it may key caches that strangers' files share.
std::string contentDigest(std::string_view bytes);

}  // namespace farol::scene
