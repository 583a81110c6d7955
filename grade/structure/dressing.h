#pragma once

#include <string>
#include <vector>

#include "grade/structure/fix.h"
#include "grade/structure/places.h"

/// The appearance of an item at its place: its mesh, its texture, its colours.
namespace farol::grade {

/// Returns fixes of matched items: codes model.*, texture.*, material.*. Visible differences only:
/// without light, diffuse alone; shininess only with a specular highlight.
std::vector<Fix> explainDress(const SearchContext& context, const Outline& mine,
                              const Matching& matching, bool isLit);

/// Fixes of matched items whose mesh is the reference's surface, from another generator and divided
/// in another way: nothing is wrong with them, and pictures of repaired scenes must not differ.
std::vector<Fix> otherDivisions(const SearchContext& context, const Outline& mine,
                                const Matching& matching);

/// Returns fixes of the scene's render settings: codes shading.*, transparency.*, background.*.
std::vector<Fix> explainSettings(const SearchContext& context, const Outline& mine, bool isLit);

/// The reference's model with its files where a repaired scene finds them.
scene::Model modelOfReference(const Outline::Item& theirs);

}  // namespace farol::grade
