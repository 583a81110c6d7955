#pragma once

#include <string>

namespace farol::server {

/// Returns 24 random characters of a-z and 2-7 without "l" and "o" (117 bits), from the kernel's
/// generator. Throws std::system_error where it fails.
std::string randomSecret();

/// Compares digests, so that the time taken does not reveal the position of the difference.
bool isSameSecret(const std::string& a, const std::string& b);

}  // namespace farol::server
