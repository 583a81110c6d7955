#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "server/assignments/assignments.h"
#include "server/catalogue.h"
#include "server/http/traffic.h"
#include "server/log.h"
#include "server/metrics.h"
#include "server/picture_cache.h"
#include "server/rate_limiter.h"
#include "server/store/scene_store.h"
#include "worker/backend.h"

namespace farol::server {

struct ServiceOptions {
    std::string scenesDir;  ///< empty: no scenes are served
    std::size_t maxBodyBytes = 16U << 20;
    std::size_t cacheBytes = std::size_t{64} << 20U;  ///< of pictures kept; 0: none
    RateLimit rate;
    std::string corsOrigin;                       ///< Access-Control-Allow-Origin; empty: not sent
    std::string basePath;                         ///< before all paths, "/farol"; empty: nothing
    std::shared_ptr<store::SceneStore> store;     ///< of uploads; never null
    std::shared_ptr<store::RecordStore> records;  ///< of assignments; never null
    /// Answers to students leave at multiples of it after their requests, so that their time does
    /// not depend on the reference; more than 0.
    std::chrono::milliseconds checkTime{5'000};
    std::string token;                      ///< that writing to the store needs; empty: none
    std::vector<std::string> allowedHosts;  ///< as SiteGuard takes them; empty: any
    std::vector<std::string> animations;    ///< names of image::kAnimations that workers can write
    std::function<std::uint64_t()> droppedLogLines = [] { return 0; };  ///< for the metrics
};

/// Dependencies of the routes' handlers. Threads share it.
struct Context {
    Context(ServiceOptions settings, worker::Backend& jobs, Logger& log)
        : options(std::move(settings)),
          backend(jobs),
          logger(log),
          store(*options.store),
          assignments(*options.records),
          scenes(options.scenesDir, store, backend, logger),
          pictures(options.cacheBytes) {}

    const ServiceOptions options;
    worker::Backend& backend;
    Logger& logger;
    store::SceneStore& store;
    Assignments assignments;
    Catalogue scenes;
    PictureCache pictures;
    Metrics metrics;
    std::function<http::Traffic()> traffic = [] { return http::Traffic{}; };
    std::atomic<bool> isDraining{false};  ///< requests are answered, readiness is false
};

}  // namespace farol::server
