#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "render/plan/camera.h"
#include "render/plan/mesh_library.h"

namespace farol::render {

/// A mesh at its place before the viewer.
struct MeshPlace {
    glm::dmat4 worldFromObject{1.0};
    bool isFlat = false;       ///< lit once a face
    bool isGouraud = false;    ///< lit at the corners of the mesh's own triangles
    bool keepsParity = false;  ///< even and odd triangles look different
    bool hasSurface = false;   ///< pixels follow their rays to the exact surface
};

/// A mesh as seen by one viewer: MeshData::eyePositions is filled, and positions() are relative to
/// the viewer, object space.
struct NearMesh {
    std::shared_ptr<const MeshData> mesh;  ///< no triangles: nothing of it is in view
    glm::dvec3 eye{0.0};                   ///< object space, less the mesh's origin
};

/// The mesh cut against the view and placed in double, where single precision would move one of
/// its triangles by more than kFloatErrorPx on the screen; nothing where it would not, or where
/// the cut mesh would have more than `maxVertices`. Triangles out of view are left out, those that
/// reach over a side of the view or over many distances are cut; parts stay.
std::optional<NearMesh> placeInDouble(const MeshData& data, const MeshPlace& place,
                                      const ViewTransform& view, std::size_t maxVertices);

/// A mesh whose positions are known in double, relative to the viewer, object space. It is always
/// cut and placed in double, even where floats would do.
struct ExactMesh {
    generator::MeshArrays arrays;  ///< its positions are not used
    std::vector<glm::dvec3> fromEye;
};
std::optional<NearMesh> placeInDouble(ExactMesh exact, const MeshPlace& place,
                                      const ViewTransform& view, std::size_t maxVertices);

/// Most error of single precision on the screen, px, that a mesh is drawn with as it is.
inline constexpr double kFloatErrorPx = 1.0 / 16.0;

}  // namespace farol::render
