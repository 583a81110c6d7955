#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>

namespace farol::worker {

struct WorkerState;

/// Facts about a job that the parent has before it runs.
struct JobFacts {
    /// Identifies document and files: selects a worker that has them cached, and is the key of
    /// the quarantine. Empty: the job has no scene.
    std::string scene;
    bool isUpload = true;  ///< has data that a client sent, beside options
};

/// Bounds of a reply; a larger one is not received.
struct ReplyLimits {
    std::uint64_t bytes = 0;    ///< of the whole reply
    std::uint64_t entries = 0;  ///< of all its lists together
};

/// Properties that most kinds of jobs share; a task that differs declares its own.
struct TaskTraits {
    /// Identical jobs in flight share one reply.
    static constexpr bool kIsShared = false;
    /// The job has no bound of cost and is never put into quarantine: it checks whether a worker
    /// works.
    static constexpr bool kIsExempt = false;
};

/// A kind of job: its files in worker/tasks/ and a row of worker/tasks/table.cpp. The members of
/// Request and Reply are serialised without further code (worker/fields.h); the parent calls
/// it by Backend::run<T>.
template <typename T>
concept Task = std::derived_from<T, TaskTraits> &&
    requires(const typename T::Request& request, typename T::Reply& reply,
             const typename T::Bounds& bounds, WorkerState& state) {
    { T::kName } -> std::convertible_to<std::string_view>;
    /// Runs in a worker. Exceptions reach the caller; an Error is the request's fault.
    { T::run(request, state) } -> std::same_as<typename T::Reply>;
    { T::factsOf(request) } -> std::same_as<JobFacts>;
    /// Upper bounds of the reply to one request; derived from ReplyLimits.
    { T::boundsOf(request) } -> std::same_as<typename T::Bounds>;
    requires std::derived_from<typename T::Bounds, ReplyLimits>;
    /// Runs in the parent. Throws WireError where the reply does not fit the request;
    /// overwrites members that a worker must not choose.
    T::accept(reply, bounds);
};

}  // namespace farol::worker
