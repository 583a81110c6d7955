#pragma once

#include <vector>

#include "grade/structure/fix.h"
#include "grade/structure/places.h"

namespace farol::grade {

/// Returns fixes of lights: codes light.*. Matches lights by their effect, not by order; ignores
/// lengths of directions. Numbers are in the light's group. Precondition: the places are equal.
std::vector<Fix> explainLights(const SearchContext& context, const Outline& mine);

/// The scenes' own cameras, as far as they show in a picture: codes camera.*.
std::vector<Fix> explainCamera(const SearchContext& context, const Outline& mine);

}  // namespace farol::grade
