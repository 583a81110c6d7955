#pragma once

#include "scene/read/findings.h"
#include "scene/scene.h"

namespace farol::scene {

/// Bounds on a scene with its scattered groups copied.
inline constexpr std::size_t kMaxInstances = 200'000;  ///< models
inline constexpr std::size_t kMaxPlaced = 1'000'000;   ///< groups and points of curves

/// Adds an error limit.instances at the innermost scattered group whose copies, nested ones
/// multiplied, are over a bound. Copies nothing. The entity is counted on its own.
void checkExpansion(const Scene& scene, Findings& findings);

}  // namespace farol::scene
