#pragma once

#include <any>
#include <functional>
#include <string>
#include <string_view>
#include <utility>

#include "core/digest.h"
#include "core/error.h"
#include "worker/enums.h"
#include "worker/quarantine.h"
#include "worker/task.h"
#include "worker/wire.h"

/// Type-erased jobs and replies, as queue, pool and processes pass them on.
namespace farol::worker {

/// A request as a worker gets it, with the facts that the parent needs about it.
struct PackedJob {
    std::string_view task;  ///< Task::kName
    std::string bytes;      ///< the name, then the request
    JobIdentity identity;
    bool isUpload = false, isShared = false;
    ReplyLimits limits;
    /// Reads a Task::Reply and checks it against the request. Throws WireError.
    std::function<std::any(Unpacker&)> readReply;
};

/// How a job ended.
enum class Outcome {
    done,
    refused,  ///< Error: the caller's fault
    broken,   ///< any other exception
    memory,   ///< the worker's memory did not suffice
    cancelled
};
constexpr Outcome lastOf(Outcome) { return Outcome::cancelled; }

/// Precedes the reply of a finished job; the whole answer of any other.
struct AnswerHead {
    Outcome outcome = Outcome::done;
    Diagnostics diagnostics;  ///< of a refusal
    std::string message;      ///< of a fault
};

struct Answer : AnswerHead {
    std::any reply;  ///< a Task::Reply, where the job is done
};

/// Reads an answer to the job. Throws WireError where it is none.
Answer readAnswer(std::string_view bytes, const PackedJob& job);

template <Task T>
PackedJob packJob(const typename T::Request& request) {
    PackedJob job;
    job.task = T::kName;
    job.bytes = pack(std::string(T::kName), request);
    JobFacts facts = T::factsOf(request);
    job.identity.scene = std::move(facts.scene);
    if (!T::kIsExempt) job.identity.request = contentDigest(job.bytes);
    job.isUpload = facts.isUpload;
    job.isShared = T::kIsShared;
    const typename T::Bounds bounds = T::boundsOf(request);
    job.limits = bounds;
    job.readReply = [bounds](Unpacker& unpacker) -> std::any {
        typename T::Reply reply;
        unpacker(reply);
        unpacker.end();
        T::accept(reply, bounds);
        return reply;
    };
    return job;
}

}  // namespace farol::worker
