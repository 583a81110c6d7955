#pragma once

#include <optional>
#include <vector>

#include "render/plan/frustum.h"
#include "render/plan/instances.h"

/// How many see-through surfaces are over each other, estimated for costs from their rectangles.
namespace farol::render {

/// The rectangles of surfaces that are blended or peeled.
class SeeThroughSurfaces {
  public:
    explicit SeeThroughSurfaces(const glm::ivec2& size) : size_(size) {}

    /// `surfaces`: of the model, over each other: 2 where its inner side shows.
    void add(const std::optional<PixelRect>& rect, double surfaces);
    /// Pixels of all surfaces together.
    double area() const { return area_; }
    /// The most over one pixel, about: at the corners and middles of the rectangles.
    double deepest() const;

  private:
    struct Surface {
        PixelRect rect;
        double count;
    };

    glm::ivec2 size_;
    double area_ = 0.0;
    std::vector<Surface> surfaces_;
};

/// Adds the see-through instances of a list, as `view` shows them.
void addSeeThrough(const InstanceList& list, const ViewTransform& view,
                   SeeThroughSurfaces& surfaces);

/// Draws of all see-through models that peel `deepest` layers: one more finds that none is left.
double peelsOf(double deepest);

}  // namespace farol::render
