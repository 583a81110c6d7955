#pragma once

#include <set>

#include "render/plan/frame_plan.h"
#include "render/plan/instances.h"
#include "render/plan/near_mesh.h"
#include "render/plan/tessellate.h"

namespace farol::render {

/// True where meshes are drawn as lines or points.
bool drawsLines(const FrameStyle& style);

/// Chooses the meshes of a frame's models: how fine, and placed by the GL or in double. The
/// arguments must outlive it; style and error bound are read when a mesh is chosen.
class MeshChoice {
  public:
    MeshChoice(const FrameStyle& style, const double& errorPx, const scene::Assets& assets,
               MeshLibrary& meshes, Diagnostics& findings)
        : style_(style), errorPx_(errorPx), assets_(assets), meshes_(meshes), findings_(findings) {}

    /// Chooses the mesh of an open model, and whether its pixels follow their rays to its surface.
    /// Scales and moves `viewFromObject` as that mesh asks for. Adds warnings scene.outline.
    /// `isClose`: its pixels have the depth of its surface, where it has one (needExactDepth).
    void refine(DrawItem& item, const Instance& instance, const InstanceList& list,
                const ViewTransform& view, glm::dmat4& viewFromObject, bool isClose);
    /// Places the mesh in double where floats would move it on the screen. Returns false where
    /// nothing of it is in view.
    bool placeNear(DrawItem& item, const Instance& instance, const ViewTransform& view,
                   glm::dmat4& viewFromObject);

  private:
    generator::Fineness finenessOf(const Instance& instance,
                                   const std::optional<ProjectedSurface>& seen,
                                   const ViewTransform& view,
                                   const glm::dmat4& viewFromObject) const;
    bool showsSurface() const;
    bool takeCap(DrawItem& item, const Instance& instance, const generator::Surface& surface,
                 const ViewTransform& view, glm::dmat4& viewFromObject);
    bool take(DrawItem& item, const std::optional<NearMesh>& near, glm::dmat4& viewFromObject);
    void warnOfOutline(const scene::Model& model, double errorPx);
    std::size_t verticesLeft() const;

    const FrameStyle& style_;
    const double& errorPx_;
    const scene::Assets& assets_;
    MeshLibrary& meshes_;
    Diagnostics& findings_;
    std::set<const scene::Model*> warned_;
    std::size_t nearVertices_ = 0;  ///< placed in double
};

}  // namespace farol::render
