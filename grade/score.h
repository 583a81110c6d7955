#pragma once

#include "grade/grader.h"

namespace farol::grade {

/// Turns what was measured and found into points: fills in criteria, costs of the findings,
/// penalty, points and passed. `scenes`: both sides are scenes, so that all criteria apply; else
/// those of pictures alone, which then share all points. `xml` is the submission's document, for
/// excerpts, `name` its name in locations.
void score(Grade& grade, const Findings& findings, const Rubric& rubric, bool scenes,
           const std::string& xml, const std::string& name);

}  // namespace farol::grade
