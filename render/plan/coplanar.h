#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "render/plan/frame_plan.h"

/// Faces of different models that lie in one plane: roads on grass, decals, labels on boxes. The
/// first of the document wins; their rounded depths alone cannot decide that.
namespace farol::render {

/// The flat parts of a mesh that are at least 1/64 of its area; none of a mesh of more than 100,000
/// triangles.
std::vector<FlatFace> flatFacesOf(const generator::Mesh& mesh);

/// Gathers the flat faces of the models of a frame.
class CoplanarFaces {
  public:
    /// Adds those of `mesh`, at viewFromObject, that face the viewer. `index`: that of `item` in
    /// the plan's items, ascending.
    void add(const MeshData& mesh, const glm::dmat4& viewFromObject, const DrawItem& item,
             std::size_t index);

    /// Sets DrawItem::depthRank: one more than that of any earlier model with a face in the plane
    /// of one of the model's that overlaps it, kMaxRank at most. Each rank moves a model back as
    /// far as its depth changes within four times GlFacts::snapPx, and by 16 units of the depth's
    /// last place. Returns how many models have one. At most kMaxPairs pairs
    /// of faces are compared, and none that look the same whichever shows.
    int rank(std::vector<DrawItem>& items, const FrameStyle& style);

    static constexpr int kMaxRank = 32;
    static constexpr std::size_t kMaxPairs = 4'000'000;

  private:
    struct Face {
        std::array<glm::dvec3, 4> corners;  ///< eye space, in turn
        glm::dvec3 normal;                  ///< unit, towards the viewer
        double distance;                    ///< of the plane from the viewer, > 0
        double slack;                       ///< by which rounding may move it
        std::uint32_t item, model;
    };
    static bool isCoplanar(const Face& a, const Face& b);
    static bool overlap(const Face& a, const Face& b);
    std::vector<Face> faces_;
};

}  // namespace farol::render
