#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/lru_cache.h"
#include "server/http/message.h"

namespace farol::server {

/// Caches image responses by entity tag. Bounded in bytes: evicts the least recently used
/// responses. Entries are never stale, since a tag is a digest of scene, options and renderer.
/// Thread-safe.
class PictureCache {
  public:
    struct Counts {
        long hits = 0, misses = 0;
    };

    /// 0 bytes: nothing is kept.
    explicit PictureCache(std::size_t bytes) : most_(bytes), kept_(bytes) {}

    /// Returns the response as it was put, with "cache" as its Server-Timing.
    std::optional<http::Response> find(const std::string& tag);
    void put(const std::string& tag, const http::Response& response);
    Counts counts() const { return {hits_, misses_}; }

  private:
    using Kept = std::shared_ptr<const http::Response>;
    const std::size_t most_;
    std::mutex mutex_;
    LruCache<std::string, Kept> kept_;
    std::atomic<long> hits_{0}, misses_{0};
};

}  // namespace farol::server
