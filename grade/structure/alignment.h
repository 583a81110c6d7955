#pragma once

#include <vector>

#include "grade/structure/candidates.h"

namespace farol::grade {

/// Returns the fewest edits (optimal string alignment with exchanges of neighbours) that make the
/// submission's chain of transforms to one item the reference's, link by link; empty where they
/// are equal, or too long.
std::vector<Edit> alignChains(const Outline& theirs, int theirItem, const Outline& mine,
                              int myItem);

}  // namespace farol::grade
