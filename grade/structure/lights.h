#pragma once

#include <vector>

#include "grade/structure/fix.h"
#include "grade/structure/places.h"

namespace farol::grade {

/// Lights, matched by what they do rather than by order: codes light.*. Lengths of directions do
/// not matter. Numbers are those of the light's own group. `mine` stands where the reference does.
std::vector<Fix> explainLights(const SearchContext& context, const Outline& mine);

/// The scenes' own cameras, as far as they show in a picture: codes camera.*.
std::vector<Fix> explainCamera(const SearchContext& context, const Outline& mine);

}  // namespace farol::grade
