#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/files/assets.h"

/// Files that shapes are made from: the bundle's first, then the built-in ones.
namespace farol::generator {

/// The built-in file of that base name ("models/teapot.patch" finds teapot.patch), or nothing.
std::optional<std::string_view> builtinFile(const std::string& path);

/// The names of all built-in files.
std::vector<std::string> builtinNames();

/// The bytes of a profile or patch file. Throws asset.missing, with the nearest name there is.
std::string readSource(const std::string& path, const scene::Assets& assets);

}  // namespace farol::generator
