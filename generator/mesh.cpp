#include "generator/mesh.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "generator/messages.h"

namespace farol::generator {
namespace {

[[noreturn]] void refuse(Message message, const std::string& fileName) {
    throw Error(std::move(message), {fileName, 0, 0});
}

template <class Vector>
void checkLength(const std::vector<Vector>& list, std::size_t positions, const Message& kind,
                 const std::string& fileName) {
    if (!list.empty() && list.size() != positions)
        refuse(
            message<"mesh.count/unequal">("file"_arg = uncut(fileName), "count"_arg = list.size(),
                                          "kind"_arg = kind, "positions"_arg = positions),
            fileName);
}

/// Parts cover the triangles in their order, without gaps.
void checkParts(const MeshArrays& arrays, const std::string& fileName) {
    std::size_t next = 0;
    for (const MeshPart& part : arrays.parts) {
        if (part.first != next || part.count % 3 != 0 || part.count > arrays.indices.size() - next)
            refuse(message<"mesh.count/parts-order">("file"_arg = uncut(fileName)), fileName);
        next += part.count;
    }
    if (!arrays.parts.empty() && (next != arrays.indices.size() || arrays.parts.size() > kMaxParts))
        refuse(message<"mesh.count/parts">(
                   "file"_arg = uncut(fileName), "parts"_arg = arrays.parts.size(),
                   "indices"_arg = next, "most"_arg = kMaxParts, "all"_arg = arrays.indices.size()),
               fileName);
}

template <int N, class Vector>
void checkNumbers(const std::vector<Vector>& list, const Message& kind,
                  const std::string& fileName) {
    for (const Vector& value : list)
        for (int k = 0; k < N; ++k)
            if (!(std::abs(double{value[k]}) <= kMaxCoordinate))
                refuse(message<"mesh.number/kind">("file"_arg = uncut(fileName), "kind"_arg = kind),
                       fileName);
}

}  // namespace

void checkCounts(std::size_t vertices, std::size_t triangles, const std::string& fileName) {
    if (triangles > kMaxTriangles)
        refuse(message<"limit.triangles/file">("file"_arg = uncut(fileName),
                                               "most"_arg = kMaxTriangles),
               fileName);
    if (vertices > kMaxVertices)
        refuse(message<"limit.triangles/vertices">("file"_arg = uncut(fileName),
                                                   "most"_arg = kMaxVertices),
               fileName);
}

void checkStructure(const MeshArrays& arrays, const std::string& fileName) {
    const std::size_t vertices = arrays.positions.size();
    checkCounts(vertices, arrays.triangles(), fileName);
    checkLength(arrays.normals, vertices, message<"part.normals">(), fileName);
    checkLength(arrays.uvs, vertices, message<"part.uvs">(), fileName);
    checkLength(arrays.colors, vertices, message<"part.colours">(), fileName);
    if (arrays.indices.size() % 3 != 0)
        refuse(message<"mesh.truncated/stored">("file"_arg = uncut(fileName),
                                                "count"_arg = arrays.indices.size()),
               fileName);
    const auto highest = std::max_element(arrays.indices.begin(), arrays.indices.end());
    if (highest != arrays.indices.end() && *highest >= vertices)
        refuse(message<"mesh.index/stored">("file"_arg = uncut(fileName), "index"_arg = *highest,
                                            "count"_arg = vertices),
               fileName);
    checkParts(arrays, fileName);
}

Mesh::Mesh(MeshArrays arrays, const std::string& fileName) {
    checkStructure(arrays, fileName);
    checkNumbers<3>(arrays.positions, message<"part.one-coordinate">(), fileName);
    checkNumbers<3>(std::vector<glm::dvec3>{arrays.origin}, message<"part.one-origin">(), fileName);
    checkNumbers<3>(arrays.normals, message<"part.one-normal">(), fileName);
    checkNumbers<2>(arrays.uvs, message<"part.one-uv">(), fileName);
    checkNumbers<2>(std::vector<glm::dvec2>{arrays.uvOrigin}, message<"part.one-uv">(), fileName);
    arrays_ = std::move(arrays);
}

}  // namespace farol::generator
