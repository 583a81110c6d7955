#pragma once

#include <string_view>

#include "scene/bundle.h"

namespace farol::scene {

/// True for the first bytes of a zip file, a tar file or a gzipped file. Looks at nothing else.
bool isArchive(std::string_view bytes);

/// The files of a zip (stored or deflated), tar or tar.gz. A folder that holds everything is left
/// out of the paths; what macOS adds is skipped. Bounded before memory is taken: entries, files,
/// bytes, and bytes against those of the archive. Throws Error bundle.damaged, bundle.path
/// (absolute, with "..", twice), bundle.entry (a link or device, encrypted, or packed otherwise),
/// limit.bundle.
std::map<std::string, std::string> readFiles(std::string_view bytes);

/// The same with the scene among them (mainOf), whose errors it throws too.
Bundle readArchive(std::string_view bytes);

}  // namespace farol::scene
