#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "server/http/message.h"

/// Percent-encoding and request targets, by RFC 3986.
namespace farol::server::http {

/// Decodes %XX (and, in queries, '+'). Nothing for a bad escape, a NUL or another control byte.
std::optional<std::string> percentDecode(std::string_view text, bool plusIsBlank);

/// Encodes all but unreserved characters; slashes stay.
std::string percentEncodePath(std::string_view text);

struct Target {
    std::string path;                    ///< starts with '/'; still encoded
    Fields query;                        ///< decoded
    std::optional<Authority> authority;  ///< of "http://host/path"
};

/// Splits the target of a request line ("/path?a=b" or "http://host/path?a=b"). Nothing when it
/// is neither, its host is malformed or an escape is bad.
std::optional<Target> parseTarget(std::string_view target);

}  // namespace farol::server::http
