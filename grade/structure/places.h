#pragma once

#include <vector>

#include "grade/structure/fix.h"
#include "grade/structure/matching.h"

namespace farol::grade {

/// The input of the search for causes.
struct SearchContext {
    const Outline& theirs;
    const Side& theirSide;
    const std::vector<double>& timesS;
    Forms& forms;
    Pictures& pictures;
    double sceneSize = 1.0;
    bool isUnclosed = false;  ///< an end tag is missing: groups under wrong parents are likely
};

/// Finds why items do not stand where the reference has them, and repairs `mine` step by step: each
/// step is the change, or the few changes, of its transforms and groups that bring most items
/// to their places for the least effort; until none is left or nothing helps. Bounded by a number
/// of steps, so that the same document gives the same causes. `matching` is kept up to date.
std::vector<Fix> explainPlaces(const SearchContext& context, Outline& mine, Matching& matching);

}  // namespace farol::grade
