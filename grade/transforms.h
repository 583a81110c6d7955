#pragma once

#include "grade/finding.h"
#include "grade/tree.h"

namespace farol::grade {

/// True if both place an object of these bounds alike: no corner is off by more than a
/// thousandth of the scene's extents (what rounding angles and lengths to three digits makes).
bool samePlace(const glm::dmat4& a, const glm::dmat4& b, const render::Box& bounds,
               double sceneSize);

/// Says why a submission's model is not where the reference has it: looks for the least change of
/// its own transforms that brings it there, at both of `times` (one may be given twice). Tried in
/// this order: two exchanged; an angle negated, given in radians; a wrong axis; signs and
/// coordinates of vectors; a number taken from the reference; one too many; one missing; a group's
/// put in another order. Codes transform.*.
Findings explainPlace(const Piece& reference, const Piece& submission, double sceneSize,
                      const glm::dvec2& times);

}  // namespace farol::grade
