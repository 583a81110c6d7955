#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/error.h"
#include "grade/structure/outline.h"
#include "grade/structure/slips.h"

namespace farol::grade {

/// One place of the submission's document, and the change of it that brings it nearer to the
/// reference.
struct Fix {
    std::string code;  ///< of kinds() in severity.h: "transform.angle-sign"
    Message who;       ///< "group \"door\"", "\"knob\"", "light 2"
    CauseWords words;  ///< the values are shown only where the rubric reveals them
    std::string kind;  ///< equal for the same misunderstanding at another place
    Location where;    ///< in the submission; line 0 where it lacks something
    std::function<void(Outline&)> apply;  ///< to the submission's outline, in any order
    int order = 0;                        ///< it was found after those of lower orders
    std::vector<int> items;               ///< the reference's items that it is about; may be empty
};

/// Returns "group "door"", "group 3 (line 41)", "the scene" for node 0.
Message nameOfNode(const Outline& outline, int node);
/// The same without the line, for a Fix, which has its own.
Message nameOfNodeAlone(const Outline& outline, int node);
/// Returns the kind of a mesh without its numbers: "sphere", "bunny.obj".
std::string meshNameOf(const scene::Model& model);
/// Returns the item as its author knows it: by its own name, its group's, or its mesh.
Message nameOfItem(const Outline& outline, int item);

}  // namespace farol::grade
