#pragma once

#include <string_view>

#include "image/decoder.h"

namespace farol::image {

/// Returns a file's Exif tag Orientation (Exif 2.32, 0x0112): 1 unchanged, 2 mirrored, 3 rotated by
/// 180 degrees, 4 flipped, 5 to 8 with rows and columns exchanged; 1 if there is none or it is
/// damaged. Reads APP1 of JPEG, EXIF of WebP and eXIf of PNG, only the first few thousand bytes of
/// their chunk.
int orientationOf(std::string_view bytes);

/// Rotates and flips the image by the tag; without samples its size alone. Precondition: 1 to 8.
void orient(Decoded& image, int orientation);

}  // namespace farol::image
