#pragma once

#include <string>
#include <vector>

#include "scene/error.h"

namespace farol::grade {

/// What a finding is about: the criteria of the structural comparison.
enum class Topic { transforms, models, textures, materials, lights, camera };

/// A difference between two scenes, told in the words of the submission's author. `code` is
/// stable (docs/grading.md lists them): "transform.order".
struct Finding {
    std::string code;
    Topic topic = Topic::transforms;
    std::string message;
    Location where;  ///< in the submission; line 0 where it lacks something
};

using Findings = std::vector<Finding>;

/// A number as people write it: at most four digits after the point, none that say nothing.
std::string shortNumber(double value);

/// " (line 14)", or nothing where the line is not known.
std::string inLine(const Location& where);

}  // namespace farol::grade
