#include <bit>
#include <cstring>
#include <numeric>

#include "generator/io/formats.h"

namespace farol::generator::io {
namespace {

constexpr std::size_t kHeader = 84;    ///< bytes: a remark of 80, and the number of triangles
constexpr std::size_t kTriangle = 50;  ///< bytes: normal, three corners, two of attributes
constexpr std::size_t kNormal = 12;    ///< bytes

std::uint32_t wordAt(std::string_view bytes, std::size_t at) {  // little-endian
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k)
        word |= std::uint32_t{static_cast<unsigned char>(bytes[at + k])} << (8 * k);
    return word;
}

/// A binary file says its length itself; some of them begin with "solid", too.
bool isBinary(std::string_view bytes) {
    return bytes.size() >= kHeader &&
           bytes.size() == kHeader + kTriangle * std::size_t{wordAt(bytes, kHeader - 4)};
}

/// Every three positions are a triangle. The facets' normals are not taken: they are the faces'
/// own where they are right, and repair.h computes those.
Mesh soup(std::vector<glm::vec3> positions, const std::string& fileName) {
    if (positions.empty())
        throw Error("mesh.empty", "the STL file holds no triangles", {fileName, 0, 0});
    checkTriangles(positions.size() / 3, fileName);
    Mesh mesh;
    mesh.positions = std::move(positions);
    mesh.indices.resize(mesh.positions.size());
    std::iota(mesh.indices.begin(), mesh.indices.end(), 0U);
    return mesh;
}

Mesh decodeBinaryStl(std::string_view bytes, const std::string& fileName) {
    const std::uint32_t triangles = wordAt(bytes, kHeader - 4);
    checkTriangles(triangles, fileName);
    std::vector<glm::vec3> positions(3 * std::size_t{triangles});
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const std::size_t at = kHeader + kTriangle * (i / 3) + kNormal + 12 * (i % 3);
        for (int k = 0; k < 3; ++k) {
            const float value =
                std::bit_cast<float>(wordAt(bytes, at + 4 * static_cast<std::size_t>(k)));
            if (!(std::abs(double{value}) <= kMaxCoordinate))
                throw Error("mesh.number", "a coordinate is no finite number within 1e18",
                            {fileName, 0, 0});
            positions[i][k] = value;
        }
    }
    return soup(std::move(positions), fileName);
}

}  // namespace

bool looksLikeStl(std::string_view bytes) {
    constexpr std::size_t kLooked = 1024;  // bytes: the name after "solid" may be long
    return isBinary(bytes) || (bytes.substr(0, 5) == "solid" &&
                               bytes.substr(0, kLooked).find("facet") != std::string_view::npos);
}

Mesh decodeStl(std::string_view bytes, const std::string& fileName) {
    if (isBinary(bytes)) return decodeBinaryStl(bytes, fileName);
    std::vector<glm::vec3> positions;
    int line = 0;
    while (!bytes.empty()) {
        ++line;
        const std::size_t end = std::min(bytes.find('\n'), bytes.size());
        const std::string_view text = bytes.substr(0, end);
        bytes.remove_prefix(std::min(end + 1, bytes.size()));
        // Of "facet normal", "outer loop", "vertex" and their ends only one has a place.
        constexpr std::string_view kVertex = "vertex";
        const std::size_t word = text.find_first_not_of(" \t\r");
        if (word == std::string_view::npos || text.compare(word, kVertex.size(), kVertex) != 0)
            continue;
        const std::size_t at = word + kVertex.size();
        const NumberRows rows =
            parseRows(text.substr(at), fileName, line, static_cast<int>(at) + 1);
        if (rows.values.size() != 3)
            rows.refuse("mesh.syntax", rows.rows[0], "a vertex has three numbers");
        positions.emplace_back(rows.values[0], rows.values[1], rows.values[2]);
    }
    if (positions.size() % 3 != 0)
        throw Error("mesh.truncated", "the last facet is incomplete", {fileName, line, 1});
    return soup(std::move(positions), fileName);
}

}  // namespace farol::generator::io
