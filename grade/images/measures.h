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

/// The least rectangle that holds every pixel which is not the same in both; empty where none is.
/// Precondition: one size.
Rectangle differing(const image::Image& first, const image::Image& second);

/// Levels at which a difference of colour counts whole: plain to see beside one another.
inline constexpr int kFullLevels = 64;

/// The pixels that show something in either picture: not the reference's most frequent colour at
/// the border, within six levels. All of them where fewer than 1 in 1,000 do.
Mask contentOf(const image::Image& reference, const image::Image& submission);

/// Both where both count.
Mask both(const Mask& a, const Mask& b);

/// The sum of a plane over the pixels that count, by their number; `least` px are counted at
/// least, so that a speck does not decide.
double shareOf(const Plane& plane, const Mask& mask, double least = 64.0);

/// One picture of layer=id as numbers; 0: nothing.
std::vector<std::uint32_t> idsOf(const image::Image& layer);

/// 1 - the mean IoU over the objects that either picture shows, edges of a pixel tolerated. Ids of
/// both pictures name the same objects; larger objects weigh by the root of their area.
double uncovered(const std::vector<std::uint32_t>& reference,
                 const std::vector<std::uint32_t>& submission, int width, int height);

/// The pixels where both pictures show the same object.
Mask shared(const std::vector<std::uint32_t>& reference,
            const std::vector<std::uint32_t>& submission);

}  // namespace farol::grade
