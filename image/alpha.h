#pragma once

#include <vector>

#include "image/image.h"

/// The alpha channel of textures.
namespace farol::image {

/// opaque: every alpha is 255. cutOut: on or off, but for texels along the edges between.
enum class Alpha { opaque, cutOut, blended };

/// An alpha from which on a texel of a cut-out is there.
inline constexpr int kHalfAlpha = 128;

/// Classifies an image. Cut-outs have texels of alpha under 8, and at most a tenth of theirs are
/// between 8 and 247. An alpha of 0 everywhere is that of a file whose writer left it unset:
/// opaque.
Alpha classifyAlpha(const Image& image);

/// Multiplies the colours by alpha, so that texels that are not there have no weight in means.
void premultiply(Image& image);

/// Scales the texels of each of `levels` (premultiplied mipmaps of `base`) by a factor a level, so
/// that the share of those that are there is that of `base`, as nearly as the level's alphas allow.
/// Without that cut-outs shrink in the distance, as means of a few texels fall under half.
void preserveCoverage(const Image& base, std::vector<Image>& levels);

}  // namespace farol::image
