#pragma once

#include "grade/images/plane.h"

namespace farol::grade {

/// Structural similarity of the luminance of two pictures (Wang, Bovik, Sheikh, Simoncelli: "Image
/// Quality Assessment", IEEE TIP 2004): windows of 11x11 px weighted by a Gaussian of 1.5 px,
/// K1 = 0.01, K2 = 0.03; luminance is 0.299 R + 0.587 G + 0.114 B of display values. -1..1, 1
/// where equal, for the centre pixel of each window within the images: the plane is 10 px smaller
/// each way and starts at pixel 5, 5.
/// Throws Error image.size unless both pictures have one size of at least 11x11 px.
Plane ssim(const FloatImage& first, const FloatImage& second);

/// The part of a mask for the plane that ssim gives of pictures `width` wide and `height` high.
Mask ssimMask(const Mask& mask, int width, int height);

inline constexpr int kSsimReach = 5;  ///< px from a window's middle to its edge

}  // namespace farol::grade
