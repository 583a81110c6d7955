#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "render/gl_facts.h"
#include "render/plan/camera.h"
#include "render/plan/mesh_library.h"

namespace farol::render {

/// The view as six planes, for boxes in its world space. All answers are conservative: they leave a
/// margin of cullingSlack, and of cullingMarginPx beside the picture. Method:
/// Assarsson and Moeller 2000, "Optimized view frustum culling algorithms for bounding boxes" (the
/// corner farthest along a plane's normal decides; planes that a group is wholly within are not
/// tried again below it).
class Frustum {
  public:
    Frustum(const ViewTransform& view, double errorPx);

    enum class Side : std::uint8_t { outside, straddles, inside };
    /// `planes`: a bit for each plane that is still to be tried; those that the box is wholly
    /// within are removed from it.
    Side test(const Box& box, unsigned& planes) const;

    static constexpr unsigned kAllPlanes = 0x3FU;

  private:
    struct Plane {
        glm::dvec3 normal;  ///< unit, inward
        double offset;      ///< inside: dot(normal, p - eye) + offset >= 0
    };
    std::array<Plane, 6> planes_;
    glm::dvec3 eye_;
    double slack_;
};

/// Returns the bound of a point's position error as a share of its distance: the rounding of single
/// precision on the way to the image, and the offset of balanced meshes from their surface, which
/// is twice errorPx at that distance.
double cullingSlack(const ViewTransform& view, double errorPx);
/// The same bound in the image, px; includes the reach of antialiasing, points and lines.
double cullingMarginPx(double errorPx);

/// An axis-aligned rectangle of the picture, px from its lower left.
struct PixelRect {
    glm::dvec2 min{0.0}, max{0.0};
};

/// Where a box (object space) falls in the picture; nothing when it reaches before the near plane.
std::optional<PixelRect> pixelRect(const Box& box, const glm::dmat4& viewFromObject,
                                   const ViewTransform& view);

/// Likewise of the part of the box that is not before the near plane; nothing where there is none.
std::optional<PixelRect> visibleRect(const Box& box, const glm::dmat4& viewFromObject,
                                     const ViewTransform& view);

/// Area of the picture within the rectangle, px; all of it where there is none.
double coveredArea(const std::optional<PixelRect>& rect, const glm::ivec2& size);

/// True if the whole box (object space) is beyond one side of the view, with the margins of a mesh
/// that stands out of its shape by up to `errorPx`.
bool isOutside(const Box& box, const glm::dmat4& viewFromObject, const ViewTransform& view,
               double errorPx);

/// True if no sample lies in the rectangle, widened by the most that the rasteriser's snapping of
/// vertices (GlFacts::snapPx) and rounding to float move an edge: nothing in it can be visible.
bool missesSamples(const PixelRect& rect, const SamplePattern& samples, double snapPx);

}  // namespace farol::render
