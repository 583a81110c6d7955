#pragma once

#include <vector>

#include "grade/structure/forms.h"
#include "grade/structure/outline.h"
#include "grade/structure/pictures.h"

namespace farol::grade {

/// A scene with the world matrices of its nodes at the compared times.
struct Side {
    const Outline* outline = nullptr;
    std::vector<Poses> poses;  ///< by time
};
Side sideOf(const Outline& outline, const std::vector<double>& timesS);

/// The submission's item for each item of the reference.
struct Matching {
    std::vector<int> mineOf;    ///< by the reference's item; -1: none
    std::vector<bool> isExtra;  ///< by the submission's item: no partner, and not removed
};

/// Matches items by form, place in the world, appearance, name, and the written chain of
/// transforms. Matches items that are equal in all of these first, and assigns the rest at the
/// least sum of costs. `sceneSize` is the extent of the reference.
Matching matchItems(const Side& theirs, const Side& mine, Forms& forms, Pictures& pictures,
                    double sceneSize);

/// Returns the links on the way from the world to a node.
std::vector<const Link*> chainOf(const Outline& outline, int node);

/// Returns the place of the least sum for each row; -1 where a column is worth `most` or more.
/// Kuhn (1955) and Munkres by shortest augmenting paths: O(rows^2 columns).
std::vector<int> assign(const std::vector<std::vector<double>>& costs, double most);

}  // namespace farol::grade
