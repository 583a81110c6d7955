#include "server/picture_cache.h"

namespace farol::server {
namespace {

// One image must not evict all others.
constexpr std::size_t kMinPictures = 4;

/// Returns its memory use, with the overhead of allocator and map: small images are no larger
/// than that.
std::size_t costOf(const std::string& tag, const http::Response& response) {
    constexpr std::size_t kBlock = 32, kBlocks = 8;
    std::size_t bytes = response.body.size() + sizeof response + 2 * tag.size() + kBlocks * kBlock;
    for (const auto& field : response.headers)
        bytes += sizeof field + field.first.size() + field.second.size() + kBlock;
    return bytes;
}

}  // namespace

std::optional<http::Response> PictureCache::find(const std::string& tag) {
    Kept found;
    {
        const std::lock_guard lock(mutex_);
        if (const Kept* kept = kept_.find(tag)) found = *kept;
    }
    ++(found ? hits_ : misses_);
    if (!found) return std::nullopt;
    return *found;  // copied outside of the lock, but for the bytes, which are shared
}

void PictureCache::put(const std::string& tag, const http::Response& response) {
    const std::size_t cost = costOf(tag, response);
    if (cost > most_ / kMinPictures) return;
    auto kept = std::make_shared<http::Response>(response);
    kept->shared = std::make_shared<const std::string>(std::move(kept->body));
    kept->body.clear();
    kept->logged.clear();
    std::erase_if(kept->headers, [](const auto& field) { return field.first == "Server-Timing"; });
    kept->set("Server-Timing", "cache;desc=hit");
    const std::lock_guard lock(mutex_);
    if (kept_.find(tag) == nullptr) kept_.put(tag, std::move(kept), cost);
}

}  // namespace farol::server
