#pragma once

#include <array>

#include "grade/images/mask.h"
#include "grade/images/plane.h"

/// FLIP: the visible difference when switching between two images (Andersson,
/// Nilsson, Akenine-Moeller, Oskarsson, Astrom, Fairchild: "FLIP: A Difference Evaluator for
/// Alternating Images", HPG 2020). Colours are filtered by the eye's contrast sensitivity, compared
/// by HyAB in Hunt-adjusted L*a*b*, and amplified where edges or points differ.
namespace farol::grade {

/// Of a 0.7 m wide screen with 3840 pixels seen from 0.7 m, as in the paper.
inline constexpr double kPixelsPerDegree = 67.0;

/// The FLIP features of one image. One reference serves many comparisons.
struct FlipPicture {
    /// Of display values 0..1 (values outside are clamped); sRGB is decoded here.
    /// `pixelsPerDegree` 1..500.
    explicit FlipPicture(const FloatImage& picture, double pixelsPerDegree = kPixelsPerDegree);

    std::array<Plane, 3> lab;  ///< filtered; L* 0..100, a* and b* scaled by 0.01 L* (Hunt)
    Plane edges, points;       ///< magnitudes of the features, 0..1 of the luminance's range
};

/// FLIP of each pixel: 0 (equal) to 1. Throws Error image.size unless both have one size.
Plane flip(const FlipPicture& reference, const FlipPicture& test);
Plane flip(const FloatImage& reference, const FloatImage& test);

/// The same for an image that equals the reference outside of `changed` (differing() of
/// measures.h): computes the pixels around it only. At kPixelsPerDegree.
Plane flip(const FlipPicture& reference, const image::Image& test, const Rectangle& changed);

}  // namespace farol::grade
