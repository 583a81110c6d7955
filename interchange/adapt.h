#pragma once

#include "core/error.h"
#include "scene/scene.h"
#include "scene/write/writer.h"

namespace farol::interchange {

/// Returns a resolved scene in the means of a dialect, for scene::write: scattered copies as
/// groups, transforms of one kind in groups of their kind, materials that give the same light under
/// the dialect's defaults. Adds a warning convert.* for each feature that the dialect lacks, at its
/// first place. Without one the written scene renders to the same image. Canonical: the scene
/// itself. Throws Error limit.instances where the copies are too many for a document.
scene::Scene adapt(const scene::Scene& scene, scene::Form form, Diagnostics& findings);

}  // namespace farol::interchange
