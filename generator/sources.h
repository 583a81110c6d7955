#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/assets.h"

/// Files that shapes are made from: the bundle's first, then the built-in ones.
namespace farol::generator {

/// The built-in file of that base name ("models/teapot.patch" finds teapot.patch), or nothing.
std::optional<std::string_view> builtinFile(const std::string& path);

/// The bytes of a profile or patch file. Throws asset.missing, with the nearest name there is.
std::string readSource(const std::string& path, const scene::Assets& assets);

/// The last part of a path; both kinds of slashes part.
std::string baseNameOf(const std::string& path);

/// "; did you mean "x"?" for the nearest of the candidates and of the bundle's files, or "".
std::string nearestFile(const std::string& name, const scene::Assets& assets,
                        std::vector<std::string> candidates = {});

}  // namespace farol::generator
