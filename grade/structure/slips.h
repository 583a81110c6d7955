#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace farol::grade {

/// The error of one transform, where another would be right.
struct Slip {
    std::string code;        ///< "transform.angle-sign"
    std::string what;        ///< "the angle has the wrong sign"
    std::string values;      ///< "is -50, expected 50"; may be empty
    std::string kind;        ///< equal for the same misunderstanding at another place
    double effort = 1.0;     ///< how unlikely a person is to make it
    scene::Transform right;  ///< the transform as it should be, to the digits of a sign or factor
};

/// Explains `mine` by `goal`: the same kind of transform with other numbers, or another kind.
/// `isExact`: `goal` is written so in the reference; else it was computed, and is rounded.
Slip slipBetween(const scene::Transform& mine, const scene::Transform& goal, bool isExact);

/// Returns whether both are one transform but for rounding.
bool isSameTransform(const scene::Transform& a, const scene::Transform& b);

/// "translate", "rotate", "scale", "rotate over time", "translate along points".
std::string wordOf(const scene::Transform& transform);
/// "translate 1 0 0", "rotate 45 about 0 1 0".
std::string textOf(const scene::Transform& transform);

/// A number as people write it: at most four digits after the point, none that say nothing.
std::string shortNumber(double value);
/// Its numbers with blanks between them: "1 0.5 0".
std::string shortNumbers(const glm::dvec3& vector);

/// Returns the nearest round number, where the value is about one.
double tidy(double value);

/// The translate, rotate and scale that a matrix is the product of, each only where it is not the
/// identity; nothing where the matrix shears.
std::optional<std::vector<scene::Transform>> decomposed(const glm::dmat4& matrix);

/// The matrix as one transform of that kind (the index of Transform), or nothing.
std::optional<scene::Transform> asTransform(const glm::dmat4& matrix, std::size_t kind);

}  // namespace farol::grade
