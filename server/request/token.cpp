#include "server/request/token.h"

#include "core/digest.h"
#include "core/error.h"
#include "core/text.h"
#include "server/messages.h"

namespace farol::server {
namespace {

// Compares digests, so that the time taken does not reveal the position of the difference.
bool sameSecret(const std::string& a, const std::string& b) {
    return contentDigest(a) == contentDigest(b);
}

std::optional<std::string> bearerOf(const http::Request& request) {
    const auto header = request.header("authorization");
    if (!header) return std::nullopt;
    const std::size_t space = header->find(' ');
    if (space == std::string::npos || !sameWord(header->substr(0, space), "bearer"))
        return std::nullopt;
    return std::string(trimmed(std::string_view(*header).substr(space), kLineBlanks));
}

}  // namespace

void requireToken(const http::Request& request, const std::string& token) {
    if (token.empty()) return;
    const auto given = bearerOf(request);
    if (!given || !sameSecret(*given, token))
        throw Error(given ? message<"http.unauthorized/token">() : message<"http.unauthorized">());
}

}  // namespace farol::server
