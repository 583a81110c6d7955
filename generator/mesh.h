#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>
#include <string>
#include <vector>

namespace farol::generator {

/// Upper bounds on one mesh, counted before memory is allocated for it.
inline constexpr std::size_t kMaxTriangles = 5'000'000;
inline constexpr std::size_t kMaxVertices = 3 * kMaxTriangles;

/// Coordinates beyond this have no use and would overflow when squared in float.
inline constexpr double kMaxCoordinate = 1e18;

/// Throws Error limit.triangles when one of the counts is over its bound.
void checkCounts(std::size_t vertices, std::size_t triangles, const std::string& fileName = {});

/// Triangles in a row that have one material of the mesh's file.
struct MeshPart {
    std::string material;   ///< its name in the file; may be empty
    std::size_t first = 0;  ///< of its indices
    std::size_t count = 0;  ///< of its indices: three a triangle
    bool operator==(const MeshPart&) const = default;
};

/// Most parts of one mesh: each is a draw call.
inline constexpr std::size_t kMaxParts = 1024;

/// The arrays of a mesh as a decoder or a shape fills them, unchecked: only Mesh is drawn.
struct MeshArrays {
    std::vector<glm::vec3> positions;  ///< relative to `origin`
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<glm::u8vec4> colors;  ///< display values 0..255 of the file's own; alpha 255
    std::vector<std::uint32_t> indices;
    std::vector<MeshPart> parts;
    glm::dvec3 origin{0.0};    ///< object space
    glm::dvec2 uvOrigin{0.0};  ///< was subtracted from all uvs

    std::size_t triangles() const { return indices.size() / 3; }
    bool operator==(const MeshArrays&) const = default;
};

/// Checks the invariants that indexing relies on: counts within their bounds; normals, uvs and
/// colours empty or as long as positions; three indices a triangle, each < positions.size(); parts
/// that cover the triangles in their order, or none. Throws Error limit.triangles, mesh.count,
/// mesh.truncated or mesh.index.
void checkStructure(const MeshArrays& arrays, const std::string& fileName = {});

/// Indexed triangles, checked. Object space, right-handed, +Y up, counter-clockwise seen from
/// outside. A vertex is at origin() + positions()[i]: origin() is 0 but for meshes that are far
/// from the origin for their size, whose positions a float cannot resolve. normals() is empty or
/// as long as positions() (unit length); uvs() (origin bottom left) and colors() are, too. A
/// vertex's texture coordinates are uvOrigin() + uvs()[i]: uvOrigin() is 0 but where they are far
/// from 0, and then whole.
/// indices() holds three entries a triangle, each < positions().size(). parts() is empty, or the
/// materials of all triangles, in their order. All numbers are finite, coordinates within
/// kMaxCoordinate.
class Mesh {
  public:
    /// No triangles.
    Mesh() = default;
    /// Checks the arrays; the only way to make a mesh. `fileName` is where the arrays come from,
    /// if from a file. Throws Error as checkStructure does, and mesh.number.
    explicit Mesh(MeshArrays arrays, const std::string& fileName = {});

    const std::vector<glm::vec3>& positions() const { return arrays_.positions; }
    const std::vector<glm::vec3>& normals() const { return arrays_.normals; }
    const std::vector<glm::vec2>& uvs() const { return arrays_.uvs; }
    const std::vector<glm::u8vec4>& colors() const { return arrays_.colors; }
    const std::vector<std::uint32_t>& indices() const { return arrays_.indices; }
    const std::vector<MeshPart>& parts() const { return arrays_.parts; }
    const glm::dvec3& origin() const { return arrays_.origin; }
    const glm::dvec2& uvOrigin() const { return arrays_.uvOrigin; }
    /// Returns the position of a vertex, object space.
    glm::dvec3 place(std::size_t vertex) const {
        return arrays_.origin + glm::dvec3(arrays_.positions[vertex]);
    }
    const MeshArrays& arrays() const { return arrays_; }

    std::size_t triangles() const { return arrays_.triangles(); }
    bool operator==(const Mesh&) const = default;

  private:
    MeshArrays arrays_;
};

}  // namespace farol::generator
