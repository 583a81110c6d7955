#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "render/plan/polygon.h"
#include "render/plan/shadow_bounds.h"
#include "render/plan/shadow_maps.h"

/// Splits of a view's depths, each with a map, where one map of a directional light is
/// coarser than pixels (cascades; Engel 2006, Zhang et al. 2006).
namespace farol::render {

/// What of the scene is in view and in a directional light's map, by its depth in the view.
class LitDepths {
  public:
    /// `map`: the light's. Slices are in a light space with its origin at the viewer, turned so
    /// that the view's direction is up in it.
    LitDepths(const InstanceList& list, const std::vector<CastingBox>& boxes,
              const ViewTransform& view, const LightView& map);

    /// How many pixels a texel of the light's map covers where it covers most; 0: it has nothing in
    /// view. `texel`: its size, world units.
    double pixelsOf(double texel) const;

    /// The maps of slices, from the nearest to the farthest: at most `most` of `side` usable texels
    /// of which none covers more than `pixels`. Empty where so many do not suffice.
    std::vector<LightView> slices(int side, int most, double pixels) const;

    /// The least `pixels`, but at least `enough`, for which there are slices; 0: none up to
    /// `acceptable`.
    double leastPixels(int side, int most, double enough, double acceptable) const;

  private:
    struct Bin {
        Box content;           ///< across, up and away in the slices' light space
        double nearest = 0.0;  ///< depth in the view
    };
    void setPlanes(const LightView& map);
    void add(const Instance& instance, const CastingBox& casting);
    void addBox(const std::array<glm::dvec3, 8>& corners);
    void addTriangles(const Instance& instance);
    void addPolygon(Polygon polygon, std::size_t planes);
    /// `nearest`: the least of the places' depths.
    void addTo(std::size_t bin, const Polygon& places, double nearest);
    std::size_t binOf(double depth) const;
    double topOf(std::size_t bin) const;
    double texelOf(const Box& content, int side) const;

    const ViewTransform& view_;
    glm::dmat3 rotation_{1.0};          ///< lightFromWorld of the slices
    glm::dmat3 lightFromEye_{1.0};      ///< likewise
    std::array<ClipPlane, 10> planes_;  ///< of the view, then of the light's map, eye space
    std::vector<Bin> bins_;             ///< by steps of depth
};

/// A directional light whose map is too coarse.
struct WideLight {
    LitDepths depths;
    double pixels;                     ///< LitDepths::pixelsOf its map
    std::vector<std::size_t> casters;  ///< that may be in its maps
};

/// The maps of each light instead of its one, the nearest slice first; none for those that keep
/// theirs. As few for each as have texels of a pixel, or the number with the finest. `count`: of
/// all maps now; `usableSide`: of a map, texels, where there are so many.
std::vector<std::vector<PlannedShadowMap>> splitMaps(const std::vector<WideLight>& lights,
                                                     const std::vector<CastingBox>& boxes,
                                                     int count,
                                                     const std::function<int(int)>& usableSide);

/// True if a map's texels may be larger than a pixel: where LitDepths are worth their time.
bool mayBeCoarse(const std::vector<CastingBox>& boxes, const ViewTransform& view, double texel);

}  // namespace farol::render
