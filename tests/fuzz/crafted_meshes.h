#pragma once

#include <cstdint>
#include <string>

namespace farol::fuzz {

struct CraftedMesh {
    std::string name;  ///< its ending is that of its format
    std::string kind;  ///< the defect
    std::string bytes;
};

/// Makes a mesh file that is wrong in one of the ways that readers get wrong: lists of different
/// lengths, counts beyond the file, indices out of range, numbers that are none, faces of many
/// corners; half of them with a few bytes changed. The same number makes the same file everywhere.
CraftedMesh craftMesh(std::uint64_t number);

}  // namespace farol::fuzz
