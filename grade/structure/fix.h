#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/error.h"
#include "grade/structure/outline.h"

namespace farol::grade {

/// One place of the submission's document, and the change of it that brings it nearer to the
/// reference.
struct Fix {
    std::string code;    ///< of kinds() in severity.h: "transform.angle-sign"
    std::string who;     ///< "group \"door\"", "\"knob\"", "the 2nd light"
    std::string what;    ///< "the angle of the rotate has the wrong sign"
    std::string values;  ///< "is -50, expected 50": shown only where the rubric reveals values
    std::string kind;    ///< equal for the same misunderstanding at another place
    Location where;      ///< in the submission; line 0 where it lacks something
    std::function<void(Outline&)> apply;  ///< to the submission's outline, whatever else was
    int order = 0;                        ///< it was found after those of lower orders
    std::vector<int> items;               ///< the reference's items that it is about; may be empty
};

/// Returns "group "door"", "the 3rd group (line 41)", "the scene" for node 0.
std::string nameOfNode(const Outline& outline, int node);
/// Returns the item as its author knows it: by its own name, its group's, or its mesh.
std::string nameOfItem(const Outline& outline, int item);
/// "a " or "an ".
std::string articleFor(const std::string& word);
/// "1st", "2nd", "3rd", "11th".
std::string ordinal(int number);

}  // namespace farol::grade
