#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace farol::generator {

/// Indexed triangles. Object space, right-handed, +Y up, counter-clockwise seen from outside.
/// normals is empty or as long as positions (unit length); uvs is empty or as long as positions
/// (origin bottom left). indices holds three entries a triangle, each < positions.size().
struct Mesh {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<std::uint32_t> indices;

    std::size_t triangles() const { return indices.size() / 3; }
    bool operator==(const Mesh&) const = default;
};

}  // namespace farol::generator
