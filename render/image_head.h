#pragma once

#include <cstdint>
#include <string_view>

/// What the first bytes of a picture file claim, read before a decoder is let at it: some take
/// memory for the whole picture, or lose it, as soon as they open a file.
namespace farol::render {

/// The pixels that a GIF or WebP file claims to have; 0 where it does not say, or for others.
/// `format` is OpenImageIO's name of it. GIF89a section 18; WebP container, RFC 9649 section 2.
std::int64_t claimedPixels(std::string_view format, std::string_view bytes);

/// True if every chunk of a PNG lies within the file, up to its end mark: known before memory is
/// taken for the pixels of a file that was cut off.
bool isWholePng(std::string_view bytes);

/// True for a WebP file of more than one frame (RFC 9649, the animation flag).
bool isAnimatedWebp(std::string_view bytes);

}  // namespace farol::render
