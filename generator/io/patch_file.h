#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace farol::generator::io {

/// Bicubic patches: sixteen point indices a patch, four rows of four.
struct PatchFile {
    std::vector<glm::dvec3> points;
    std::vector<std::array<std::uint32_t, 16>> patches;
};

/// Reads a `.patch` file: patch count; 16 indices a line; point count; `x, y, z` lines. Throws
/// Error mesh.* with the line of the fault.
PatchFile parsePatchFile(std::string_view bytes, const std::string& fileName);

}  // namespace farol::generator::io
