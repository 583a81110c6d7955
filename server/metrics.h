#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <utility>

#include "server/backend.h"
#include "server/http/traffic.h"
#include "server/picture_cache.h"

namespace farol::server {

/// What /metrics tells, in the text format of Prometheus, version 0.0.4. Threads may share it.
class Metrics {
  public:
    /// `route` is a pattern ("/v1/scenes/{id}"), never a path: there are few of them.
    void request(const std::string& route, int status, double milliseconds);
    /// `stage` as in Server-Timing.
    void stage(const std::string& stage, double milliseconds);
    std::string text(const BackendState& backend, PictureCache::Counts pictures, bool storeUp,
                     const http::Traffic& traffic, const std::string& version,
                     const std::string& renderer) const;

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
    std::map<std::pair<std::string, int>, std::uint64_t> requests_;
    Histogram duration_;
    std::map<std::string, Histogram> stages_;
};

}  // namespace farol::server
