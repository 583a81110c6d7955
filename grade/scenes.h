#pragma once

#include <optional>
#include <vector>

#include "grade/finding.h"
#include "grade/tree.h"

namespace farol::grade {

/// Which piece of the submission stands for each of the reference's, and what differs.
struct SceneComparison {
    std::vector<std::optional<std::size_t>> mineOf;  ///< by the reference's piece
    std::vector<bool> extra;                         ///< by the submission's: no partner
    Findings findings;
};

/// Compares two scenes by what they are made of, whatever the order of groups, models, lights and
/// attributes, however groups are split, and whichever transforms lead to the same place.
/// `times` are those of the pictures: motion is compared at both.
SceneComparison compareScenes(const Tree& reference, const Tree& submission,
                              const glm::dvec2& times);

}  // namespace farol::grade
