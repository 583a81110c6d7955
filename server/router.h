#pragma once

#include <functional>
#include <string>
#include <vector>

#include "server/http/message.h"

namespace farol::server {

/// What a handler of a route gets: the request, the value of the path's {parameter} (decoded),
/// and the body.
struct Call {
    const http::Request& request;
    http::Body& body;
    std::string parameter;
};

/// One line of the table of routes.
struct Route {
    std::string method;
    std::string pattern;  ///< "/v1/scenes/{id}/image"; {id} may span several segments
    std::function<http::Response(const Call&)> handle;
    bool isWriting = false;  ///< what is kept is changed: the token is needed, where one is set
};

class Router {
  public:
    explicit Router(std::vector<Route> routes);

    /// Runs the route's handler. Throws Error http.not-found or http.method (then `allowed` of
    /// the path is not empty), and what the handler throws. OPTIONS is answered for every path.
    http::Response route(const http::Request& request, http::Body& body) const;

    /// The route that answers the request, or null.
    const Route* find(const http::Request& request) const;

    /// The methods that a path answers, HEAD and OPTIONS included: "GET, HEAD, OPTIONS".
    std::string allowed(const std::string& path) const;

    /// The pattern that decides what a path is, "/v1/scenes/{id}"; empty where there is none.
    std::string patternOf(const std::string& path) const;

    const std::vector<Route>& routes() const { return routes_; }

  private:
    std::vector<Route> routes_;
};

}  // namespace farol::server
