#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "core/message.h"
#include "scene/scene.h"

namespace farol::grade {

/// The words of a cause.
struct CauseWords {
    Message finding;  ///< "the angle of the rotate has the wrong sign"
    Message values;   ///< "it is -50, expected 50"; may be empty
};

/// "translate", "rotate", "scale", "rotate over time", "translate along points".
Message elementOf(const scene::Transform& transform);
/// "translate 1 0 0", "rotate 45 about 0 1 0".
Message textOf(const scene::Transform& transform);
/// "x", "x and y", "x, y and z".
Message listOf(const std::vector<std::string>& words);

/// "it is 1, expected 2".
Message twoValues(double mine, double right);
Message twoValues(const glm::dvec3& mine, const glm::dvec3& right);
Message twoValues(const std::string& mine, const std::string& right);

/// Formats a number with at most four digits after the point and no trailing zeros.
std::string shortNumber(double value);
/// A colour as scenes write it, 0 to 255: "255 127.5 0".
std::string levels(const scene::Color& color);
/// Its numbers with blanks between them: "1 0.5 0".
std::string shortNumbers(const glm::dvec3& vector);

}  // namespace farol::grade
