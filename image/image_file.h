#pragma once

#include <string>
#include <string_view>

#include "core/error.h"
#include "image/decoder.h"
#include "image/image.h"

namespace farol::image {

/// The size of an image file, px.
struct ImageSize {
    int width, height;
    bool mayHaveAlpha = false;  ///< it has an alpha channel, which may be 255 throughout
};

/// Reads the head of an image file without decoding its pixels. Throws as decodeImage does for
/// all that the head shows.
ImageSize imageSize(std::string_view bytes, const std::string& name, const Location& where = {});

/// Decodes a PNG, JPEG, WebP, GIF, BMP, TGA, PNM, Radiance, OpenEXR or TIFF file, recognised by its
/// first bytes (TGA by the ending of its name). Grey becomes RGB; missing alpha 255. Throws Error
/// image.unreadable or limit.texture, which name the file and `where`. A file that is damaged but
/// has an image sets `damage`: "is cut off"; where that is null, it is image.unreadable.
Image decodeImage(std::string_view bytes, const std::string& name, const Location& where = {},
                  std::string* damage = nullptr);

}  // namespace farol::image
