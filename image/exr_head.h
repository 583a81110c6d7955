#pragma once

#include <cstdint>
#include <string_view>

namespace farol::image {

/// The first part of an OpenEXR file, as far as it is drawn.
struct ExrHead {
    /// Columns and rows from `left` and `top` on, in the file's own coordinates.
    struct Window {
        std::int64_t left = 0, top = 0, width = 0, height = 0;
    };
    Window display;                     ///< the image
    Window data;                        ///< where the file has pixels
    bool isGrey = false;                ///< Y instead of R, G and B
    bool hasAlpha = false;              ///< multiplied into the colours
    int tileWidth = 0, tileHeight = 0;  ///< 0: rows

    int channels() const { return (isGrey ? 1 : 3) + (hasAlpha ? 1 : 0); }
};

/// Reads the heads of all parts ("OpenEXR File Layout") without decoding. Throws std::runtime_error
/// where the file is damaged, deep, has no channels R, G and B or Y of full size, or where a part
/// needs more memory than an image of kMaxTexturePixels; a larger display window is no error.
ExrHead readExrHead(std::string_view bytes);

}  // namespace farol::image
