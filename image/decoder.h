#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

/// Decoders of image files, one per format, behind image_file.h.
namespace farol::image {

/// Largest image that is decoded, px.
inline constexpr std::int64_t kMaxTexturePixels = 64'000'000;

/// Decoded image file: rows from the top, 8 bits a sample, samples of a pixel interleaved.
/// A decoder announces the size before it writes samples; memory exists only for an announced size
/// within kMaxTexturePixels, and is zeroed.
class Decoded {
  public:
    int width = 0, height = 0;
    int channels = 0;  ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA; straight alpha, which may be
                       ///< 255 throughout where the file has none
    std::vector<std::uint8_t> samples;
    /// Damage that left an image all the same: "is cut off: ..."; empty where there is none.
    std::string damage;

    std::int64_t pixels() const { return std::int64_t{width} * height; }
    std::size_t rowSize() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
    }
    std::uint8_t* row(int y) { return samples.data() + static_cast<std::size_t>(y) * rowSize(); }

    /// Sets the size. Throws std::runtime_error for an empty one. Returns false where the image is
    /// larger than kMaxTexturePixels: the decoder returns without samples.
    bool announce(std::int64_t newWidth, std::int64_t newHeight, int newChannels) {
        constexpr std::int64_t kMaxInt = 0x7fffffff;
        if (newWidth <= 0 || newHeight <= 0 || newChannels <= 0)
            throw std::runtime_error("it has no pixels");
        if (newWidth > kMaxInt || newHeight > kMaxInt || newChannels > 4)
            throw std::runtime_error("its size is out of range");
        width = static_cast<int>(newWidth);
        height = static_cast<int>(newHeight);
        channels = newChannels;
        return pixels() <= kMaxTexturePixels;
    }
    /// Takes zeroed memory for the announced size.
    void allocate() {
        samples.assign(static_cast<std::size_t>(pixels()) * static_cast<std::size_t>(channels), 0);
    }
};

/// Sets the size, and the samples too where `wantsPixels` and the size is within
/// kMaxTexturePixels. Throws std::exception with the reason.
void readPng(std::string_view bytes, bool wantsPixels, Decoded& out);   // PNG 1.2, by libpng
void readJpeg(std::string_view bytes, bool wantsPixels, Decoded& out);  // ITU T.81, by libjpeg
void readWebp(std::string_view bytes, bool wantsPixels, Decoded& out);  // RFC 9649, first frame
void readGif(std::string_view bytes, bool wantsPixels, Decoded& out);   // GIF89a, first frame
void readPnm(std::string_view bytes, bool wantsPixels, Decoded& out);   // P1 to P6 of Netpbm
void readBmp(std::string_view bytes, bool wantsPixels, Decoded& out);   // Windows and OS/2 1.x
void readTga(std::string_view bytes, bool wantsPixels, Decoded& out);   // Truevision TGA 2.0
void readHdr(std::string_view bytes, bool wantsPixels, Decoded& out);   // Radiance, clamped to 0..1
void readTiff(std::string_view bytes, bool wantsPixels, Decoded& out);  // TIFF 6.0, by libtiff
void readExr(std::string_view bytes, bool wantsPixels, Decoded& out);   // OpenEXR 2, by module.h

}  // namespace farol::image
