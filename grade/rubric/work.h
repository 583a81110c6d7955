#pragma once

#include <cstdint>
#include <vector>

#include "grade/structure/outline.h"
#include "render/plan/instances.h"

namespace farol::grade {

/// The worth of each object of a reference, and the pixels of its views that show it.
struct Work {
    std::vector<double> weights;  ///< by item; the sum is 1, or 0 where there are none
    /// By view, which item each pixel shows, from 1; 0: none.
    std::vector<std::vector<std::uint32_t>> items;
};

/// Shares half of the work equally among the objects, half by the root of the pixels that they
/// cover over the views: small objects count, and so do objects that fill the image. `numbers`: by
/// view, the numbers of a layer=id image of `list`.
Work workOf(const Outline& outline, const render::InstanceList& list,
            std::vector<std::vector<std::uint32_t>> numbers);

/// The share of weighted work that `changed` spoils, 0..1. By view, each pixel's change 0..1
/// against the reference's own picture.
class Spoiled {
  public:
    explicit Spoiled(const Work& work);
    void add(std::size_t view, const std::vector<float>& changed);
    double share() const;

  private:
    const Work& work_;
    std::vector<double> sums_, areas_;
    double background_ = 0.0;
};

}  // namespace farol::grade
