#pragma once

#include <string>

namespace farol {

/// RFC 4648, with padding: what a data: URL takes.
std::string base64(const std::string& bytes);

}  // namespace farol
