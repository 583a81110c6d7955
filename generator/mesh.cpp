#include "generator/mesh.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"

namespace farol::generator {
namespace {

std::string nameOf(const std::string& fileName) {
    return fileName.empty() ? "the mesh" : "the mesh file \"" + fileName + "\"";
}

[[noreturn]] void refuse(const char* code, const std::string& fileName,
                         const std::string& message) {
    throw Error(code, nameOf(fileName) + " " + message, {fileName, 0, 0});
}

template <class Vector>
void checkLength(const std::vector<Vector>& list, std::size_t positions, const char* what,
                 const std::string& fileName) {
    if (!list.empty() && list.size() != positions)
        refuse("mesh.count", fileName,
               "has " + std::to_string(list.size()) + " " + what + " for " +
                   std::to_string(positions) + " positions; expected one each");
}

/// Parts cover the triangles in their order, without gaps.
void checkParts(const MeshArrays& arrays, const std::string& fileName) {
    std::size_t next = 0;
    for (const MeshPart& part : arrays.parts) {
        if (part.first != next || part.count % 3 != 0 || part.count > arrays.indices.size() - next)
            refuse("mesh.count", fileName, "has parts that do not cover its triangles in order");
        next += part.count;
    }
    if (!arrays.parts.empty() && (next != arrays.indices.size() || arrays.parts.size() > kMaxParts))
        refuse("mesh.count", fileName,
               "has " + std::to_string(arrays.parts.size()) + " parts of " + std::to_string(next) +
                   " indices; expected at most " + std::to_string(kMaxParts) + " parts of all " +
                   std::to_string(arrays.indices.size()));
}

template <int N, class Vector>
void checkNumbers(const std::vector<Vector>& list, const char* what, const std::string& fileName) {
    for (const Vector& value : list)
        for (int k = 0; k < N; ++k)
            if (!(std::abs(double{value[k]}) <= kMaxCoordinate))
                refuse("mesh.number", fileName,
                       std::string("has ") + what + " that is not a finite number within 1e18");
}

}  // namespace

void checkCounts(std::size_t vertices, std::size_t triangles, const std::string& fileName) {
    if (triangles > kMaxTriangles)
        refuse("limit.triangles", fileName,
               "has more than " + std::to_string(kMaxTriangles) + " triangles");
    if (vertices > kMaxVertices)
        refuse("limit.triangles", fileName,
               "has more than " + std::to_string(kMaxVertices) + " vertices");
}

void checkStructure(const MeshArrays& arrays, const std::string& fileName) {
    const std::size_t vertices = arrays.positions.size();
    checkCounts(vertices, arrays.triangles(), fileName);
    checkLength(arrays.normals, vertices, "normals", fileName);
    checkLength(arrays.uvs, vertices, "texture coordinates", fileName);
    checkLength(arrays.colors, vertices, "colours", fileName);
    if (arrays.indices.size() % 3 != 0)
        refuse("mesh.truncated", fileName,
               "has " + std::to_string(arrays.indices.size()) +
                   " indices; expected a multiple of three");
    const auto highest = std::max_element(arrays.indices.begin(), arrays.indices.end());
    if (highest != arrays.indices.end() && *highest >= vertices)
        refuse("mesh.index", fileName,
               "has the index " + std::to_string(*highest) + "; there are " +
                   std::to_string(vertices) + " vertices, counted from 0");
    checkParts(arrays, fileName);
}

Mesh::Mesh(MeshArrays arrays, const std::string& fileName) {
    checkStructure(arrays, fileName);
    checkNumbers<3>(arrays.positions, "a coordinate", fileName);
    checkNumbers<3>(std::vector<glm::dvec3>{arrays.origin}, "an origin", fileName);
    checkNumbers<3>(arrays.normals, "a normal", fileName);
    checkNumbers<2>(arrays.uvs, "a texture coordinate", fileName);
    arrays_ = std::move(arrays);
}

}  // namespace farol::generator
