#pragma once

#include <vector>

#include "grade/requirements/evaluate.h"

namespace farol::grade {

/// Checks the mesh files whose names are like the selector's pattern, 64 at most. Returns how many
/// are what its shape makes; the faults of the others go to `misses`, with the vertex's line.
int countFiles(const MeshSelector& selector, const scene::Assets& files,
               std::vector<RequiredThing>& matches, std::vector<RequiredThing>& misses);

}  // namespace farol::grade
