#pragma once

#include <string>

#include "server/http/listener.h"
#include "server/queue.h"
#include "server/rate_limiter.h"

namespace farol::server {

/// What `farol serve` is told. The fields' defaults are the documented ones.
struct ServeOptions {
    http::ListenOptions listen;
    std::string scenesDir;                ///< empty: no scenes are served
    int workers = 0;                      ///< processes that draw, 1..64; 0: one a core, at most 8
    int spares = 1;                       ///< processes kept ready to take a lost one's place
    int recycleAfter = 1'000;             ///< jobs a process does before it is replaced
    std::size_t workerMemoryMiB = 2'048;  ///< a process may take; 0: no cap
    std::chrono::milliseconds quarantine{600'000};  ///< of a scene that ended two workers
    QueueLimits queue{0, std::chrono::milliseconds(2'000), std::chrono::milliseconds(10'000)};
    ///< queue.waiting 0: four a worker, at least 16
    std::size_t maxBodyBytes = 16U << 20;
    std::size_t cacheBytes = std::size_t{64} << 20U;  ///< of pictures kept in the parent; 0: none
    RateLimit rate;
    std::string corsOrigin;        ///< empty: no CORS headers
    std::string dataDir;           ///< of uploaded scenes; empty: they live in memory
    std::string storeUrl;          ///< of a Redis that keeps them instead, shared with others
    std::uint64_t storeBytes = 0;  ///< of uploads; 0: 1 GiB, 128 MiB in memory
    std::chrono::milliseconds expire{7LL * 24 * 3600 * 1000};  ///< of uploads; 0: never
    std::string token;  ///< that writing needs; empty: $FAROL_TOKEN, else none
};

/// Serves until SIGTERM or SIGINT, then lets the requests in flight end. Prints one line,
/// "listening on http://127.0.0.1:8080", to stdout when it is ready to accept (with the port
/// taken where `listen.port` is 0); logs to stderr, one line of JSON a request. Returns 0. Throws
/// std::runtime_error when it cannot listen and Error option.range or asset.missing for options
/// that cannot be. Call it before other threads are started: it blocks the signals for all.
int serve(const ServeOptions& options);

}  // namespace farol::server
