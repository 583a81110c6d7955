#include "server/router.h"

#include <algorithm>
#include <optional>

#include "core/error.h"
#include "server/http/uri.h"
#include "server/messages.h"

namespace farol::server {
namespace {

// The value of the pattern's {parameter} ("" where it has none), or nothing for no match.
std::optional<std::string> match(const std::string& pattern, const std::string& path) {
    const std::size_t open = pattern.find('{');
    if (open == std::string::npos)
        return pattern == path ? std::optional<std::string>("") : std::nullopt;
    const std::string_view before = std::string_view(pattern).substr(0, open);
    const std::string_view after = std::string_view(pattern).substr(pattern.find('}') + 1);
    if (path.size() <= before.size() + after.size() || !path.starts_with(before) ||
        !path.ends_with(after))
        return std::nullopt;
    return http::percentDecode(
        std::string_view(path).substr(before.size(), path.size() - before.size() - after.size()),
        false);
}

}  // namespace

Router::Router(std::vector<Route> routes) : routes_(std::move(routes)) {
    // /v1/scenes/{id}/image before /v1/scenes/{id}, which it would match too.
    std::stable_sort(routes_.begin(), routes_.end(), [](const Route& a, const Route& b) {
        return std::pair(b.pattern.size(), a.pattern) < std::pair(a.pattern.size(), b.pattern);
    });
}

http::Response Router::route(Context& context, const http::Request& request,
                             http::Body& body) const {
    const std::string* known = nullptr;  // the first matching pattern decides
    for (const Route& route : routes_) {
        if (known != nullptr && route.pattern != *known) break;
        auto parameter = match(route.pattern, request.path);
        if (!parameter) continue;
        known = &route.pattern;
        if (route.method == request.method)
            return route.handle(context, Call{request, body, std::move(*parameter)});
    }
    if (known == nullptr)
        throw Error(message<"http.not-found/path">("path"_arg = uncut(request.path)));
    if (request.method != "OPTIONS")
        throw Error(message<"http.method">("method"_arg = request.method,
                                           "allowed"_arg = allowed(request.path)));
    http::Response response;
    response.status = 204;
    response.set("Allow", allowed(request.path));
    return response;
}

const Route* Router::find(const http::Request& request) const {
    const std::string_view pattern = patternOf(request.path);
    for (const Route& route : routes_)
        if (route.pattern == pattern && route.method == request.method) return &route;
    return nullptr;
}

std::string Router::allowed(const std::string& path) const {
    std::string out;
    const std::string* known = nullptr;
    for (const Route& route : routes_) {
        if (known != nullptr && route.pattern != *known) break;
        if (!match(route.pattern, path)) continue;
        known = &route.pattern;
        out += (out.empty() ? "" : ", ") + route.method;
        if (route.method == "GET") out += ", HEAD";
    }
    return out.empty() ? out : out + ", OPTIONS";
}

const Route* Router::firstOf(const std::string& path) const {
    for (const Route& route : routes_)
        if (match(route.pattern, path)) return &route;
    return nullptr;
}

std::string_view Router::patternOf(const std::string& path) const {
    const Route* const route = firstOf(path);
    return route == nullptr ? std::string_view() : route->pattern;
}

bool Router::drawsProblem(const std::string& path) const {
    const Route* const route = firstOf(path);
    return route != nullptr && route->traits.drawsProblem;
}

}  // namespace farol::server
