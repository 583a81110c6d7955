#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/lru_cache.h"
#include "grade/rubric/grader.h"
#include "render/renderer.h"

namespace farol::worker {

/// A serialised rubric. Workers parse it once for each digest.
struct PackedRubric {
    std::string json;    ///< grade::writeRubric
    std::string digest;  ///< of `json`
};
PackedRubric packRubric(const grade::Rubric& rubric);

/// Ends a job whose reply nobody waits for.
struct Cancelled {};

/// State that a worker keeps between jobs.
struct WorkerState {
    /// `maxCost`: core-seconds that all frames of a job may cost together (render/plan/cost.h); 0:
    /// no bound. Throws std::runtime_error where there is no GL.
    WorkerState(double maxCost, render::GlSource source);

    const grade::Rubric& rubric(const PackedRubric& packed);

    render::Renderer renderer;
    grade::Grader grader{renderer};
    const double maxCost;
    /// Whether nobody waits for the reply to the job. A task of many frames asks before each one,
    /// and throws Cancelled.
    std::function<bool()> isCancelled = [] { return false; };

  private:
    LruCache<std::string, grade::Rubric> rubrics_;
};

}  // namespace farol::worker
