#pragma once

#include "grade/finding.h"
#include "grade/surface.h"
#include "grade/tree.h"

/// What a model shows at its place: its mesh, its texture, its colours.
namespace farol::grade {

/// Meshes that are not the same surface: codes model.*, texture.*. `surface` compares the two.
Findings compareMeshes(const Piece& reference, const Piece& submission, const Surface& surface);

/// Codes texture.*. Pictures are compared by what they show, not by name or format.
Findings compareTextures(const Tree& reference, const Piece& theirs, const Tree& submission,
                         const Piece& mine);

/// Codes material.*. Only what can be seen: without light, diffuse alone; shininess only where
/// something shines.
Findings compareMaterials(const Piece& reference, const Piece& submission, bool lit);

}  // namespace farol::grade
