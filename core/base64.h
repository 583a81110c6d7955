#pragma once

#include <string>

namespace farol {

/// Encodes in base64 with padding (RFC 4648), for data: URLs.
std::string base64(const std::string& bytes);

}  // namespace farol
