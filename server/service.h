#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <string>

#include "server/client_bytes.h"
#include "server/context.h"
#include "server/http/message.h"
#include "server/rate_limiter.h"
#include "server/request/problem.h"
#include "server/router.h"
#include "server/site_guard.h"

namespace farol::server {

/// The REST interface (docs/reference/http.md) without sockets and without GL: admits requests,
/// hands them to their routes and turns errors into problem documents.
class Service final : public http::Handler {
  public:
    Service(ServiceOptions options, worker::Backend& backend, Logger& logger);

    std::size_t bodyLimit(const http::Request& request) const override;
    http::Response handle(const http::Request& request, http::Body& body) override;
    http::Response refuse(const http::Request& request, int status,
                          const Message& message) override;
    void finished(const http::Request& request, const http::Response& response, double milliseconds,
                  bool sent) override;

    /// Readiness turns false; requests are still answered.
    void drain() { context_.isDraining = true; }
    /// Sets the source of the connections' metrics. Call it before the first request.
    void watch(std::function<http::Traffic()> traffic) { context_.traffic = std::move(traffic); }
    const Router& router() const { return router_; }
    const std::string& basePath() const { return context_.options.basePath; }

  private:
    /// Returns the problem of the exception being handled.
    Problem problemOfCurrent(const http::Request& request);
    /// Returns the request without the base path. Other paths stay: probes do not use it, and a
    /// proxy may have removed it.
    http::Request inside(const http::Request& request) const;
    http::Response answer(const http::Request& request, http::Body& body);
    void finish(const http::Request& request, http::Response& response) const;
    void sweep();

    Context context_;
    std::atomic<std::chrono::steady_clock::rep> swept_{0};  ///< when the store last expired scenes
    RateLimiter limiter_;
    ClientBytes bodies_;
    SiteGuard guard_;
    Router router_;
};

}  // namespace farol::server
