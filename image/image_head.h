#pragma once

#include <cstdint>
#include <string_view>

/// Facts about an image file that are read before a decoder takes memory or time.
namespace farol::image {

/// Scans of a JPEG file that are decoded. Encoders write 10 for colour and 18 for CMYK.
inline constexpr int kMaxJpegScans = 50;

/// The scans of a JPEG file, counted without decoding; ITU T.81, annex B.
int countJpegScans(std::string_view bytes);

/// The pixels that the head of a WebP file announces, 0 where it does not; RFC 9649 section 2.
std::int64_t announcedWebpPixels(std::string_view bytes);

/// True if every chunk of a PNG lies within the file, up to its end mark: known before memory is
/// taken for the pixels of a file that was cut off.
bool isWholePng(std::string_view bytes);

/// True for a WebP file of more than one frame (RFC 9649, the animation flag).
bool isAnimatedWebp(std::string_view bytes);

}  // namespace farol::image
