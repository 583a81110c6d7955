#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "grade/images/flip.h"
#include "image/image.h"

namespace farol::grade {

/// Parts of a frame beside its colours.
struct FrameParts {
    bool flip = false, ids = false, depth = false, normals = false;

    bool hasLayers() const { return ids || depth || normals; }
    bool covers(const FrameParts& needed) const {
        return flip >= needed.flip && ids >= needed.ids && depth >= needed.depth &&
               normals >= needed.normals;
    }
    void add(const FrameParts& more) {
        flip = flip || more.flip;
        ids = ids || more.ids;
        depth = depth || more.depth;
        normals = normals || more.normals;
    }
};

/// One view of a scene, or a picture. Only the parts that are needed are there.
struct Frame {
    image::Image color, depth, normal;
    std::vector<std::uint32_t> ids;   ///< of the objects; those of both sides name the same ones
    std::optional<FlipPicture> flip;  ///< of references: it serves all comparisons
};

/// Both sides of a view, and the derived data that several metrics share, computed on first use.
/// Precondition: frames of one size; they and `hidden` outlive the pair.
class FramePair {
  public:
    /// `hidden` does not count; nor, if `hidesAxes`, do coordinate axes.
    FramePair(const Frame& reference, const Frame& submission, const std::vector<Rectangle>& hidden,
              bool hidesAxes);

    const Frame& reference() const { return reference_; }
    const Frame& submission() const { return submission_; }
    int width() const { return reference_.color.width; }
    int height() const { return reference_.color.height; }
    bool hasSameColors() const { return hasSameColors_; }
    /// The difference of colours beyond a pixel's shift.
    const Plane& beyond();
    /// The pixels that the rubric lets count.
    const Mask& counted();
    /// The pixels that show something in either, without the axes; the rubric's masks not applied.
    const Mask& content();
    /// The pixels where both show the same object.
    const Mask& sharedObjects();

  private:
    const Frame& reference_;
    const Frame& submission_;
    const std::vector<Rectangle>& hidden_;
    const bool hidesAxes_, hasSameColors_;
    std::optional<Plane> beyond_;
    std::optional<Mask> counted_, content_, sharedObjects_;
};

}  // namespace farol::grade
