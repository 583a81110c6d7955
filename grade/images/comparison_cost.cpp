#include "grade/images/comparison_cost.h"

#include <string>

namespace farol::grade {
namespace {
// Core-seconds of a pixel for all that is measured and encoded: 8.5 were taken by 16 million.
constexpr double kPixelCost = 0.55e-6;
}  // namespace

void spendOnComparison(render::CostBudget& budget, int width, int height) {
    budget.spend(kPixelCost * width * height, "comparing images of " + std::to_string(width) +
                                                  " x " + std::to_string(height) + " px");
}

}  // namespace farol::grade
