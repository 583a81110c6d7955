#pragma once

#include <string>
#include <vector>

namespace farol::image {

/// Returns the path of a module's file: beside the program (built or copied), installed, or one or
/// two folders above the tests; beside the program where it is in none of these.
std::string findModule(const std::string& file);

/// Loads a module for the rest of the process. Returns its function of that name. Throws
/// std::runtime_error with the reason of the loader.
void* loadFunction(const std::string& path, const char* name);

/// The files of all modules, which a sandbox must leave readable.
const std::vector<std::string>& moduleFiles();

}  // namespace farol::image
