#include "server/request/token.h"

#include "core/error.h"
#include "core/text.h"
#include "server/messages.h"
#include "server/secret.h"

namespace farol::server {
std::optional<std::string> bearerOf(const http::Request& request) {
    const auto header = request.header("authorization");
    if (!header) return std::nullopt;
    const std::size_t space = header->find(' ');
    if (space == std::string::npos || !sameWord(header->substr(0, space), "bearer"))
        return std::nullopt;
    return std::string(trimmed(std::string_view(*header).substr(space), kLineBlanks));
}

void requireToken(const http::Request& request, const std::string& token) {
    if (token.empty()) return;
    const auto given = bearerOf(request);
    if (!given || !isSameSecret(*given, token))
        throw Error(given ? message<"http.unauthorized/token">() : message<"http.unauthorized">());
}

void requireTeacher(const http::Request& request, const std::string& token) {
    if (token.empty()) throw Error(message<"assignment.no-token">());
    requireToken(request, token);
}

}  // namespace farol::server
