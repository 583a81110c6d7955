#pragma once

#include <string>

#include "render/plan/frame_plan.h"

/// The cost of a frame, estimated from its plan before anything is drawn. The unit is a
/// core-second: one second of one core of the machine that the constants in cost.cpp were measured
/// on (docs/explanation/performance.md). The estimate errs upwards: it is there to refuse, not to
/// schedule.
namespace farol::render {

struct FrameCost {
    double pixels = 0.0;     ///< resolve, read-back, encoding and peeled layers, core-seconds
    double fragments = 0.0;  ///< shading
    double geometry = 0.0;   ///< triangles and draw calls, in every pass
    double total() const { return pixels + fragments + geometry; }
};

/// Counts blended and peeled models by their opacity; by the alpha of their textures once
/// FramePlan::textureAlphas is known.
FrameCost estimateCost(const FramePlan& plan);

/// See-through surfaces behind each other, about, where they are most.
double deepestSeeThrough(const FramePlan& plan);

/// Core-seconds to shade a fragment of the item.
double fragmentCost(const FramePlan& plan, const DrawItem& item);
/// Core-seconds of the depths alone of a model: `fragments` of all passes together.
double depthCostOf(double triangles, double fragments, int passes);

/// The core-seconds that frames may cost together.
class CostBudget {
  public:
    CostBudget() = default;  ///< no bound
    /// 0: no bound.
    explicit CostBudget(double coreSeconds) : left_(coreSeconds), whole_(coreSeconds) {}

    /// Announces `frames` frames like the next one: the next one is refused if all together exceed
    /// the budget.
    void expectFrames(int frames) { frames_ = frames; }
    /// Counts a frame before it is drawn. Throws Error limit.cost, whose message names the options
    /// to lower.
    void spend(const FramePlan& plan);
    /// Counts work on images that is no frame. Throws Error limit.cost; `work` names it:
    /// "comparing images of 4000 x 4000 px".
    void spend(double coreSeconds, const std::string& work);

  private:
    double left_ = 0.0, whole_ = 0.0;
    int frames_ = 1;
};

}  // namespace farol::render
