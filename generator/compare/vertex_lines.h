#pragma once

#include <glm/glm.hpp>
#include <string_view>
#include <vector>

namespace farol::generator {

/// Returns the line of a mesh file, from 1, that has the position of each vertex, whatever the
/// file's form: the first three numbers of a line before three in its middle. Of vertices at one
/// place the k-th has the k-th such line. 0 where the text does not show it (binary files).
std::vector<int> vertexLines(std::string_view text, const std::vector<glm::dvec3>& positions);

}  // namespace farol::generator
