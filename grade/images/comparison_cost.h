#pragma once

#include "render/plan/cost.h"

namespace farol::grade {

/// Counts the comparison of two images of that size, px, against the budget. Throws Error
/// limit.cost.
void spendOnComparison(render::CostBudget& budget, int width, int height);

}  // namespace farol::grade
