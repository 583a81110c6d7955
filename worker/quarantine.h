#pragma once

#include <chrono>
#include <map>
#include <mutex>
#include <set>
#include <string>

namespace farol::worker {

/// A job as the quarantine knows it: digests, either may be empty.
struct JobIdentity {
    std::string scene;    ///< document and files; empty: the job has no scene
    std::string request;  ///< scene, task and options; empty: the job is exempt
};

/// Counts how often jobs ended their workers. After kRequestStrikes in a row a request is not
/// tried again for a while, other requests for its scene are. A scene is closed for all only after
/// crashes by kSceneStrikes different requests: deadline, CPU time and memory depend on the
/// options, a crash shows a fault of ours that the scene reaches. Bounded; thread-safe.
class Quarantine {
  public:
    using Clock = std::chrono::steady_clock;
    static constexpr int kRequestStrikes = 2;
    static constexpr std::size_t kSceneStrikes = 3;
    static constexpr std::size_t kMaxEntries = 4'096;  ///< of requests, and of scenes

    enum class Cause {
        crash,
        exhausted,  ///< deadline, CPU time or memory
    };
    struct Closed {
        std::chrono::seconds left{0};  ///< zero: the job may be tried
        bool isScene = false;          ///< the scene is closed, not just this request
    };

    explicit Quarantine(std::chrono::seconds duration) : duration_(duration) {}

    Closed closed(const JobIdentity& job, Clock::time_point now = Clock::now());
    void strike(const JobIdentity& job, Cause cause, Clock::time_point now = Clock::now());
    /// Forgets the request's strikes; those of other requests for its scene stay.
    void success(const JobIdentity& job);

  private:
    struct Request {
        int strikes = 0;
        Clock::time_point last;
    };
    struct Scene {
        std::set<std::string> requests;  ///< that crashed; at most kSceneStrikes
        Clock::time_point last;
    };
    template <typename Entry>
    Entry& entryOf(std::map<std::string, Entry>& entries, const std::string& key,
                   Clock::time_point now);
    template <typename Entry>
    std::chrono::seconds left(const Entry& entry, Clock::time_point now) const;

    const std::chrono::seconds duration_;
    std::mutex mutex_;
    std::map<std::string, Request> requests_;
    std::map<std::string, Scene> scenes_;
};

}  // namespace farol::worker
