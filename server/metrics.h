#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "server/http/traffic.h"
#include "server/picture_cache.h"
#include "worker/backend.h"

namespace farol::server {

/// The content of /metrics in the text format of Prometheus, version 0.0.4. Thread-safe.
class Metrics {
  public:
    /// `route`: a pattern ("/v1/scenes/{id}"), not a path: bounds the number of time series.
    void request(std::string_view route, int status, double milliseconds);
    /// `stage` as in Server-Timing.
    void stage(const std::string& stage, double milliseconds);
    std::string text(const worker::BackendState& backend, PictureCache::Counts pictures,
                     bool storeUp, const http::Traffic& traffic, std::uint64_t droppedLogLines,
                     const std::string& version, const std::string& renderer) const;

  private:
    static constexpr std::array<double, 13> kBoundsS{0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1,
                                                     0.25,  0.5,    1.0,   2.5,  5.0,   10.0};
    struct Histogram {
        std::array<std::uint64_t, kBoundsS.size()> counts{};  ///< not yet summed up
        std::uint64_t count = 0;
        double sumS = 0;
        void add(double seconds);
    };
    static void write(std::string& out, const std::string& name, const std::string& label,
                      const Histogram& histogram);

    mutable std::mutex mutex_;
    /// Counters of one route.
    struct RouteCounts {
        std::map<int, std::uint64_t> byStatus;
        std::uint64_t count = 0;
        double sumS = 0;
    };
    std::map<std::string, RouteCounts, std::less<>> routes_;  ///< by pattern
    Histogram duration_;
    std::map<std::string, Histogram> stages_;
};

}  // namespace farol::server
