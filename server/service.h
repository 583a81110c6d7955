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
    /// Where the metrics learn of connections. Call it before the first request.
    void watch(std::function<http::Traffic()> traffic) { context_.traffic = std::move(traffic); }
    const Router& router() const { return router_; }
    const std::string& basePath() const { return context_.options.basePath; }

  private:
    /// The problem that the exception being handled is.
    Problem problemOfCurrent(const http::Request& request);
    /// The request without the base path. Of others the path stays: probes ask without it, and a
    /// proxy may have taken it off.
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
