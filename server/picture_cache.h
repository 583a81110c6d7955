#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "core/lru_cache.h"
#include "server/http/message.h"

namespace farol::server {

/// Pictures that were sent, by entity tag, within a bound of bytes: the least recently used go
/// first. A tag names scene, options and renderer, so what is here is never out of date. Threads
/// may share it.
class PictureCache {
  public:
    struct Counts {
        long hits = 0, misses = 0;
    };

    /// 0 bytes: nothing is kept.
    explicit PictureCache(std::size_t bytes) : most_(bytes), kept_(bytes) {}

    /// The response as it was put, but for its times: they tell of a cache, not of a drawing.
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
