#pragma once

#include <string>

#include "scene/scene.h"

namespace farol::scene {

/// The scene as canonical XML: every element spelt one way, included files in place, colours by
/// value. Reading it back gives an equal scene (see equality.h); what the resolver filled in is
/// not written. An entity is written as the name of its file.
std::string write(const Scene& scene);

}  // namespace farol::scene
