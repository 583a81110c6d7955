#pragma once

#include <string>

#include "render/image.h"
#include "render/options.h"

namespace farol::render {

/// PNG, 8 bits: RGB when every alpha is 255, else RGBA. Filter Sub, ISA-L level 2: measured
/// best in time for their size on rendered pictures (docs/decisions/0010-png.md).
std::string encodePng(const Image& image);
/// Baseline JPEG 4:4:4 on black; quality 1..100. For fast frames.
std::string encodeJpeg(const Image& image, int quality);
/// Lossy WebP with alpha; quality 1..100.
std::string encodeWebp(const Image& image, int quality);

std::string encode(const Image& image, Format format, int quality);
/// "image/png", "image/jpeg", "image/webp".
const char* contentType(Format format);

}  // namespace farol::render
