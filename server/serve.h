#pragma once

#include <string>

#include "server/http/listener.h"
#include "server/rate_limiter.h"
#include "worker/queue.h"

namespace farol::server {

/// Settings of `farol serve`. The fields' defaults are the documented ones.
struct ServeOptions {
    http::ListenOptions listen;
    std::string scenesDir;                ///< empty: no scenes are served
    int workers = 0;                      ///< processes that draw, 1..64; 0: one a core, at most 8
    int spares = 1;                       ///< processes kept ready to take a lost one's place
    int recycleAfter = 1'000;             ///< jobs a process does before it is replaced
    std::string gl = "auto";              ///< a word of render::kGlSourceWords
    std::string isolate = "none";         ///< uploads: a process ends after each job of one
    std::size_t workerMemoryMiB = 2'048;  ///< a process may take; 0: no cap
    std::chrono::milliseconds cpu{0};     ///< of a worker for one request; 0: twice the deadline
    double maxCost = 0;  ///< estimated core-seconds of a request; 0: 1.5 times the deadline
    std::chrono::milliseconds quarantine{600'000};  ///< of requests and scenes that end workers
    worker::QueueLimits queue{0, std::chrono::milliseconds(2'000),
                              std::chrono::milliseconds(10'000)};
    ///< queue.waiting 0: four a worker, at least 16
    std::size_t maxBodyBytes = 16U << 20;
    std::size_t cacheBytes = std::size_t{64} << 20U;  ///< of pictures kept in the parent; 0: none
    RateLimit rate;
    std::string corsOrigin;  ///< empty: no CORS headers
    std::string basePath;    ///< prefix of all paths, "/farol"; empty: none
    /// Names, comma-separated, that clients may use for the service; "*": any; empty: loopback
    /// names and listen.host where that is a loopback address, else any.
    std::string allowedHosts;
    int maxConnections = 0;              ///< at once; 0: 1024, or as many as descriptors allow
    int connectionsPerClient = 0;        ///< 0: seven eighths of them; all with rate.trustProxy
    std::chrono::milliseconds drain{0};  ///< unready, but still serving, before the end
    std::string dataDir;                 ///< of uploaded scenes; empty: they live in memory
    std::string storeUrl;                ///< of a Redis that keeps them instead, shared with others
    std::uint64_t storeBytes = 0;        ///< of uploads; 0: 1 GiB, 128 MiB in memory
    std::chrono::milliseconds expire{7LL * 24 * 3600 * 1000};  ///< of uploads; 0: never
    std::string token;  ///< that writing needs; empty: $FAROL_TOKEN, else none
    std::chrono::milliseconds checkTime{5'000};  ///< ServiceOptions::checkTime
};

/// Serves until SIGTERM, SIGINT or SIGHUP. Then it is unready and goes on serving for
/// `drain`, or until a second signal, and lets the requests in flight end. Prints one line,
/// "listening on http://127.0.0.1:8080", to stdout when it is ready to accept (with the port
/// chosen where `listen.port` is 0); logs to stderr, one line of JSON a request. Returns 0. Throws
/// std::runtime_error when it cannot listen and Error option.range or asset.missing for invalid
/// options. Call it before other threads are started: it blocks the signals for all.
int serve(const ServeOptions& options);

}  // namespace farol::server
