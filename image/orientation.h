#pragma once

#include <string_view>

#include "image/decoder.h"

namespace farol::image {

/// How a file's rows are to be shown, by its Exif tag Orientation (Exif 2.32, 0x0112): 1 as they
/// are, 2 mirrored, 3 turned by half, 4 upside down, 5 to 8 with rows and columns exchanged. Reads
/// APP1 of JPEG, EXIF of WebP and eXIf of PNG, nothing behind the first few thousand bytes of their
/// chunk; 1 where there is none or it is damaged.
int orientationOf(std::string_view bytes);

/// Rotates and flips the image by the tag; without samples its size alone. Precondition: 1 to 8.
void orient(Decoded& image, int orientation);

}  // namespace farol::image
