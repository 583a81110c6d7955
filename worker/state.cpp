#include "worker/state.h"

#include "core/digest.h"
#include "grade/rubric/rubric.h"

namespace farol::worker {
namespace {
constexpr std::size_t kMaxRubrics = 16;
}  // namespace

PackedRubric packRubric(const grade::Rubric& rubric) {
    std::string json = grade::writeRubric(rubric);
    std::string digest = contentDigest(json);
    return {std::move(json), std::move(digest)};
}

WorkerState::WorkerState(double maxCoreSeconds, render::GlSource source)
    : renderer(source), maxCost(maxCoreSeconds), rubrics_(kMaxRubrics) {}

const grade::Rubric& WorkerState::rubric(const PackedRubric& packed) {
    if (const grade::Rubric* known = rubrics_.find(packed.digest)) return *known;
    return rubrics_.put(packed.digest, grade::readRubric(packed.json, "rubric.json"), 1);
}

}  // namespace farol::worker
