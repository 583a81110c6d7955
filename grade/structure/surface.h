#pragma once

#include <glm/glm.hpp>
#include <memory>

#include "generator/mesh.h"
#include "scene/files/assets.h"
#include "scene/scene.h"

namespace farol::grade {

/// How two meshes at their places differ: shares 0..1 of the submission's corners. The comparison
/// of positions, normals and texture coordinates does not depend on the order of vertices and
/// triangles, nor on the tessellation.
struct Surface {
    bool isCompared = false;  ///< false: too large, or nothing to compare
    double common = 0;        ///< the smaller share, of either, of corners on the other's surface
    double normalsSame = 0, normalsOpposite = 0;
    double normalsUntransposed = 0;  ///< transformed as directions, not by the inverse transpose
    double normalsOfFaces = 0;       ///< those of the face where the reference is smooth
    double windingReversed = 0;      ///< triangles whose front is the reference's back
    bool hasUvs = false;             ///< both have texture coordinates
    double uvSame = 0, uvUpsideDown = 0, uvMirrored = 0, uvBoth = 0, uvSwapped = 0;

    /// Returns whether both are one surface, ignoring normals and texture coordinates.
    bool isOnePlace() const;
    /// Returns whether nothing above differs by more than rounding. `textured`: texture
    /// coordinates count.
    bool isSame(bool textured) const;
};

/// A reference's mesh, prepared for comparisons: its triangles in a grid, those of a curved shape
/// finer than the mesh, as the exact surface has them.
class KnownMesh {
  public:
    KnownMesh(const scene::Model& model, const generator::Mesh& mesh, const scene::Assets& assets);
    ~KnownMesh();
    KnownMesh(KnownMesh&&) noexcept;
    KnownMesh& operator=(KnownMesh&&) noexcept;

    const generator::Mesh& mesh() const { return *mesh_; }
    struct Grid;
    const Grid& grid() const { return *grid_; }

  private:
    const generator::Mesh* mesh_;
    std::unique_ptr<Grid> grid_;
};

/// Compares a submission's mesh, brought to the reference's object space by `theirsFromMine`.
Surface compareSurfaces(const KnownMesh& theirs, const generator::Mesh& mine,
                        const glm::dmat4& theirsFromMine);

/// The share and place of a mesh's area, for a quick look: centre and covariance of its surface.
struct Moments {
    double area = 0.0;
    glm::dvec3 middle{0.0};
    glm::dmat3 spread{0.0};
};
Moments momentsOf(const generator::Mesh& mesh, const glm::dmat4& matrix);

}  // namespace farol::grade
