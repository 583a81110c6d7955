#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "core/bounded_json.h"
#include "grade/images/mask.h"
#include "image/image.h"

namespace farol::grade {

/// Levels (of 255) whose share of pixels is counted: none, rounding, drivers, filters.
inline constexpr std::array<int, 4> kLevels{0, 2, 6, 24};

/// The difference of two images of one size, in levels 0..255 of premultiplied RGBA.
/// A pixel's difference is the largest over its channels; its tolerant difference is the least
/// over the 3x3 pixels around the same place of the other image, the larger of both directions:
/// an edge that moved by a pixel costs nothing, an object in one image only costs its whole area.
struct Comparison {
    int width = 0, height = 0;
    double meanLevels = 0.0, tolerantMeanLevels = 0.0;
    int maxLevels = 0, tolerantMaxLevels = 0;
    double psnrDb = 0.0;  ///< over red, green and blue; infinity where they are equal
    /// Share of pixels, 0..1, whose difference is at most kLevels[i].
    std::array<double, kLevels.size()> within{}, tolerantWithin{};
    double counted = 0.0;  ///< share of the pixels that the mask lets count, 0..1
    Summary flip{};        ///< see grade/images/flip.h; the first picture is the reference
    std::optional<double>
        ssim{};  ///< mean, see grade/images/ssim.h; nothing for pictures below 11x11 px
};

/// Compares the pixels of the mask. Throws Error image.size when the sizes differ or are zero,
/// image.mask when the mask is empty. The second value shows the differences: the first image at a
/// quarter of its brightness, with the tolerant difference in red, amplified eight times.
std::pair<Comparison, image::Image> compare(const image::Image& first, const image::Image& second,
                                            const Mask& mask = {});

/// Returns a JSON object; PSNR is null for equal images, SSIM for too small ones.
std::string toJson(const Comparison& comparison);
/// Limits for parsing that document.
inline constexpr JsonLimits kComparisonJson{.bytes = 65'536};

/// Parses a rectangle "WxH+X+Y", px. Throws Error option.range, which names `field`.
Rectangle readRectangle(const std::string& text, const std::string& field);

/// The part that `wanted` names: "" all of it, "auto" the client area of a screenshot, else a
/// rectangle, unless the picture has that size already. Throws as readRectangle and crop do.
image::Image cut(const image::Image& image, const std::string& wanted);

/// That part of the picture. Throws Error image.crop when it is empty or reaches beyond it.
image::Image crop(const image::Image& image, const Rectangle& part);

/// Cells of a coarse mask, across and down.
inline constexpr int kMaskColumns = 16, kMaskRows = 12;
/// Returns a character for each cell, in rows from the top: "1" where a twentieth or more of its
/// pixels differ (a plane of 0..1), else "0".
std::string coarseMask(const Plane& plane);

/// A plane of 0..1 as a picture: black, violet, red, orange, yellow, white.
image::Image heatMap(const Plane& plane);

}  // namespace farol::grade
