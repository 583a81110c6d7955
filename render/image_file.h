#pragma once

#include <string>
#include <string_view>

#include "render/image.h"
#include "scene/error.h"

namespace farol::render {

/// Largest picture that is decoded.
inline constexpr std::int64_t kMaxTexturePixels = 64'000'000;

/// The size of a picture file, px.
struct ImageSize {
    int width, height;
};

/// Reads the head of a picture file without decoding its pixels. Throws as decodeImage does for
/// what the head tells.
ImageSize imageSize(std::string_view bytes, const std::string& name, const Location& where = {});

/// Decodes a PNG, JPEG, WebP, BMP, TGA, GIF, TIFF, PNM or Radiance file, told by its first bytes
/// (TGA by its name). Grey becomes RGB; missing alpha 255. Throws Error image.unreadable or
/// limit.texture, which name the file and `where`.
Image decodeImage(std::string_view bytes, const std::string& name, const Location& where = {});

}  // namespace farol::render
