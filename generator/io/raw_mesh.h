#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "core/error.h"
#include "generator/mesh.h"

namespace farol::generator::io {

/// A mesh as read, unchecked, with positions and texture coordinates in double.
struct RawMesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;  ///< empty: computed; invalid ones are replaced
    std::vector<glm::dvec2> uvs;
    std::vector<glm::u8vec4> colors;
    std::vector<std::uint32_t> indices;
    std::vector<MeshPart> parts;
    /// Vertices with the same number share a computed normal; empty: each has its own.
    std::vector<std::uint32_t> smooth;
    std::map<std::string, std::size_t> leftOut;  ///< kinds of data that are not drawn, with counts
    Diagnostics findings;

    std::size_t triangles() const { return indices.size() / 3; }
};

/// Converts positions and texture coordinates to float. Subtracts an origin if the mesh is more
/// than 64 times as far away as it is large, and whole turns from texture coordinates far from 0.
/// The origin is a multiple of a power of two of at least the mesh's size: no digit is lost. NaN
/// texture coordinates become 0 and are counted in `leftOut`. Moves the arrays out of
/// `raw`; `smooth`, `leftOut` and `findings` stay.
MeshArrays settle(RawMesh& raw);

/// Returns the origin that `settle` subtracts from these positions: 0 if they need none.
glm::dvec3 originOf(const std::vector<glm::dvec3>& positions);

/// A channel of a file as 0..255: rounded, NaN as 0. `most` is its full value, 1 or 255.
std::uint8_t channelOf(double value, double most);

/// Adds a warning about the file as a whole.
void warn(Diagnostics& findings, const std::string& file, Message message);

/// Splits vertices between triangles of different colours: `colors` has one a triangle. A vertex is
/// kept once a colour, and copies share their computed normal.
void splitByColor(RawMesh& raw, const std::vector<glm::u8vec4>& colors);

}  // namespace farol::generator::io
