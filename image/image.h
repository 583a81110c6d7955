#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace farol::image {

/// 8-bit RGBA, top row first, straight alpha, display values (no colour management).
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> pixels;  ///< width * height * 4
    bool operator==(const Image&) const = default;
};

/// True if every alpha is 255.
bool isOpaque(const Image& image);

/// Scales to at most `width` x `height`, each axis for itself. A texel is the area-weighted mean of
/// the texels it covers.
Image scaleDown(Image image, int width, int height);

/// The levels below `base`, each half as large (rounded down, at least 1) down to 1x1. Every texel
/// is the area-weighted mean of the texels it covers, so sizes that are no powers of two are
/// right too: [0,255,0,255,255] gives 102,204. Rows run as in `base`.
std::vector<Image> buildMipmaps(const Image& base);

}  // namespace farol::image
