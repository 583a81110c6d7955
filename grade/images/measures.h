#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "grade/images/mask.h"
#include "image/image.h"

/// Measures of two images of one size for a grade. All shares are 0 (alike) to 1.
namespace farol::grade {

/// Returns, by pixel, the difference that a shift by one pixel does not explain: by channel, the
/// distance from the least to largest level of the other image's 3x3 pixels around, the larger of
/// both directions, as a share of `full` levels (at most 1). An edge that moved by a pixel, or that
/// was smoothed, costs nothing. Colours as composited over black.
Plane beyondAPixel(const image::Image& first, const image::Image& second, int full);

/// Returns the smallest rectangle with all pixels that differ; empty if the images are equal.
/// Precondition: one size.
Rectangle differing(const image::Image& first, const image::Image& second);

/// Levels of a full difference of colour: plainly visible side by side.
inline constexpr int kFullLevels = 64;

/// Returns the pixels with content in either image: more than six levels from the reference's
/// most frequent colour at the border. All pixels where fewer than 1 in 1,000 have content.
Mask contentOf(const image::Image& reference, const image::Image& submission);

/// Returns the intersection.
Mask both(const Mask& a, const Mask& b);

/// Returns the mean of a plane over the mask's pixels; divides by `least` px at least, so that
/// a few pixels do not decide.
double shareOf(const Plane& plane, const Mask& mask, double least = 64.0);

/// Decodes a layer=id image to object numbers; 0: no object.
std::vector<std::uint32_t> idsOf(const image::Image& layer);

/// Returns 1 - the mean IoU of the objects visible in either image, tolerating edges of one pixel.
/// Ids of both images name the same objects; the weight of an object is the root of its area.
double uncovered(const std::vector<std::uint32_t>& reference,
                 const std::vector<std::uint32_t>& submission, int width, int height);

/// Returns the pixels that show the same object in both images.
Mask shared(const std::vector<std::uint32_t>& reference,
            const std::vector<std::uint32_t>& submission);

}  // namespace farol::grade
