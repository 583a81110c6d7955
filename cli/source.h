#pragma once

#include <string>

#include "render/renderer.h"

namespace farol::cli {

/// The job of a scene or mesh file: its bytes, and the files beside it (or in `assets`, where that
/// is not empty). Throws as readInput does.
render::Job openSource(const std::string& path, const std::string& assets, bool strict);

}  // namespace farol::cli
