#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/http/message.h"

namespace farol::server {

struct Context;

/// Arguments of a route's handler: the request, the value of the path's {parameter} (decoded), and
/// the body.
struct Call {
    const http::Request& request;
    http::Body& body;
    std::string parameter;
};

/// Properties of a route beside its handler.
struct RouteTraits {
    bool isWriting = false;     ///< changes stored scenes: needs the token if one is set
    bool drawsProblem = false;  ///< onerror=image: a problem becomes a picture
    bool isTeachers = false;    ///< needs the token, and a server that has one
};

/// One line of the table of routes.
struct Route {
    /// Throws Error, Busy or ProblemException, which become problem documents.
    using Handle = http::Response (*)(Context&, const Call&);

    std::string method;
    std::string pattern;  ///< "/v1/scenes/{id}/image"; {id} may span several segments
    Handle handle;
    RouteTraits traits;
};

class Router {
  public:
    explicit Router(std::vector<Route> routes);

    /// Runs the route's handler. Throws Error http.not-found or http.method (then `allowed` of the
    /// path is not empty), and the handler's exceptions. OPTIONS is answered for every path.
    http::Response route(Context& context, const http::Request& request, http::Body& body) const;

    /// The route that answers the request, or null.
    const Route* find(const http::Request& request) const;
    /// True if a problem of the path may become an image, with any method.
    bool drawsProblem(const std::string& path) const;

    /// The methods that a path answers, HEAD and OPTIONS included: "GET, HEAD, OPTIONS".
    std::string allowed(const std::string& path) const;

    /// Returns the first pattern that matches a path, "/v1/scenes/{id}"; empty where there is none.
    std::string_view patternOf(const std::string& path) const;

    const std::vector<Route>& routes() const { return routes_; }

  private:
    const Route* firstOf(const std::string& path) const;

    std::vector<Route> routes_;
};

}  // namespace farol::server
