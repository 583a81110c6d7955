#pragma once

#include <string>

#include "generator/mesh.h"
#include "scene/files/assets.h"
#include "scene/scene.h"

namespace farol::grade {

/// Returns the name of the shape that a model has: of a shape's call that shape; of a mesh file the
/// shape whose form its vertices have (plane, box, cylinder, cone, sphere, ellipsoid, torus; about
/// any axis), "patch" where a patch file of the submission, or a generator comment, makes it, and
/// else "file".
std::string formOf(const scene::Model& model, const generator::Mesh& mesh,
                   const scene::Scene& scene, const scene::Assets& assets);

}  // namespace farol::grade
