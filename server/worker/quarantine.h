#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <string>

namespace farol::server::worker {

/// Remembers scenes that ended workers: after two strikes without a success between them a scene
/// is not tried again for a while. Bounded; used by many threads.
class Quarantine {
  public:
    using Clock = std::chrono::steady_clock;
    static constexpr int kStrikes = 2;
    static constexpr std::size_t kMaxScenes = 4'096;

    explicit Quarantine(std::chrono::seconds duration) : duration_(duration) {}

    /// How long the scene is still kept out; zero: it may be tried.
    std::chrono::seconds left(const std::string& scene, Clock::time_point now = Clock::now());
    void strike(const std::string& scene, Clock::time_point now = Clock::now());
    void success(const std::string& scene);

  private:
    struct Entry {
        int strikes = 0;
        Clock::time_point last;
    };
    const std::chrono::seconds duration_;
    std::mutex mutex_;
    std::map<std::string, Entry> entries_;
};

}  // namespace farol::server::worker
