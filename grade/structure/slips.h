#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "grade/structure/cause_text.h"

namespace farol::grade {

/// The error of one transform, where another would be right.
struct Slip {
    std::string code;  ///< "transform.angle-sign"
    /// Makes the words; called for reported slips only, since the search discards most.
    std::function<CauseWords()> words;
    std::string kind;        ///< equal for the same misunderstanding at another place
    double effort = 1.0;     ///< how unlikely a person is to make it
    scene::Transform right;  ///< the transform as it should be, to the digits of a sign or factor
};

/// Changes of the whole scene: one transform that makes up for it.
Slip slipOfWhole(const scene::Transform& needed);
/// Several transforms, which no slip of one of them explains; none: they are not shown.
Slip slipOfPlace(bool isWhole, const std::vector<scene::Transform>& parts, double effort);

/// Slips of transforms that are too much, missing, or in another order than the one after them.
Slip slipOfExtra(const scene::Transform& extra, double effort);
Slip slipOfMissing(const scene::Transform& missing, double effort);
Slip slipOfOrder(const scene::Transform& first, const scene::Transform& second, double effort);

/// Explains `mine` by `goal`: the same kind of transform with other numbers, or another kind.
/// `isExact`: `goal` is written so in the reference; else it was computed, and is rounded.
Slip slipBetween(const scene::Transform& mine, const scene::Transform& goal, bool isExact);

/// The same for a vector that an element or attribute holds: "translate", "scale", "position". The
/// right one is a Scale where it is "scale", else a Translate.
Slip slipOfVector(const glm::dvec3& mine, const glm::dvec3& goal, const std::string& element);

/// Returns whether both are one transform but for rounding.
bool isSameTransform(const scene::Transform& a, const scene::Transform& b);

/// Returns the nearest round number, where the value is about one.
double tidy(double value);

/// Decomposes a matrix into translate, rotate and scale, without identities; nothing if it
/// shears.
std::optional<std::vector<scene::Transform>> decomposed(const glm::dmat4& matrix);

/// The matrix as one transform of that kind (the index of Transform), or nothing.
std::optional<scene::Transform> asTransform(const glm::dmat4& matrix, std::size_t kind);

}  // namespace farol::grade
