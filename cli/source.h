#pragma once

#include <string>

#include "render/renderer.h"

namespace farol::cli {

/// Returns the job of a scene or mesh file: its bytes, and the files beside it (or in `assets`
/// unless that is empty). Throws as readInput does.
render::Job openSource(const std::string& path, const std::string& assets, bool strict);

/// The folder of the files that the scene names.
std::string assetFolder(const std::string& path, const std::string& assets);

}  // namespace farol::cli
