#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/lru_cache.h"
#include "generator/mesh.h"
#include "generator/registry.h"
#include "render/plan/close_pairs.h"
#include "scene/files/assets.h"
#include "scene/scene.h"

namespace farol::render {

/// Axis-aligned box; empty when min > max.
struct Box {
    glm::dvec3 min{1e300}, max{-1e300};
    bool empty() const { return min.x > max.x; }
    void add(const glm::dvec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    /// Corner 0 to 7: bits 0, 1 and 2 choose the greater x, y and z.
    glm::dvec3 corner(int i) const {
        return {i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z};
    }
};

/// The whole triangle that a vertex lies in, where light is worked out at its corners.
struct LitCorners {
    glm::vec3 positions[3];  ///< eye space
    glm::vec3 normals[3];    ///< object space
    glm::vec3 shares;        ///< the vertex's barycentric coordinates
};

/// Triangles of a mesh that lie in one plane: a rectangle round them, object space, corners in
/// turn, counter-clockwise as seen from their front.
struct FlatFace {
    std::array<glm::dvec3, 4> corners;
};

/// A mesh with the derived data that the plan needs. `id` is unique in the process.
struct MeshData {
    std::uint64_t id = 0;
    generator::Mesh mesh;
    Box bounds;               ///< object space
    double filled = 1.0;      ///< share of its box's sides that its triangles cover, about
    glm::dvec3 balance{1.0};  ///< generator::balancedScale, where the mesh was asked to be balanced
    double fullTurn = 0.0;    ///< generator::fullTurnOf, likewise
    std::vector<FlatFace> flats;  ///< its large flat parts (coplanar.h)
    Diagnostics findings;         ///< repairs of its file
    /// Where the vertices are for one viewer, eye space; empty: where their matrix puts them
    /// (near_mesh.h).
    std::vector<glm::vec3> eyePositions;
    std::vector<LitCorners> litCorners;  ///< likewise of each vertex, for gouraud
    std::vector<glm::vec3> faceCenters;  ///< likewise the middle of each vertex's face, for flat
};

/// A number for MeshData::id.
std::uint64_t nextMeshId();

/// Bytes that a mesh takes.
std::size_t bytesOf(const MeshData& data);

/// Meshes by source, kept within a bound of bytes, least recently used first out.
class MeshLibrary {
  public:
    explicit MeshLibrary(std::size_t maxBytes) : meshes_(maxBytes) {}
    /// The mesh of a resolved model. Throws as generator::load does.
    std::shared_ptr<const MeshData> get(const scene::Model& model, const scene::Assets& assets);
    /// Returns the mesh of an adaptive model (generator::isAdaptive) of that fineness. `coarse`:
    /// the result of get() without fineness for the model.
    std::shared_ptr<const MeshData> get(const MeshData& coarse, const scene::Model& model,
                                        const scene::Assets& assets,
                                        const generator::Fineness& fineness);
    /// Known pairs of these meshes.
    ClosePairs& closePairs() { return closePairs_; }

  private:
    /// By the text of its source, or by the coarse mesh's id and the fineness.
    struct Key {
        std::string source;
        std::uint64_t coarse = 0;
        double error = 0.0, fullTurn = 0.0, straightSide = 0.0;
        bool balanced = false, textured = false;
        auto operator<=>(const Key&) const = default;
    };
    /// `coarse`: MeshData::id.
    std::shared_ptr<const MeshData> refined(std::uint64_t coarse, const scene::Model& model,
                                            const scene::Assets& assets,
                                            const generator::Fineness& fineness);
    std::shared_ptr<const MeshData> keep(const Key& key, generator::Mesh mesh,
                                         Diagnostics findings = {},
                                         const generator::ShapeCall* balanced = nullptr);
    LruCache<Key, std::shared_ptr<const MeshData>> meshes_;
    ClosePairs closePairs_;
};

}  // namespace farol::render
