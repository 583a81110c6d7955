#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace farol::image {

struct Image;

/// PNG, 8 bits: RGB when every alpha is 255, else RGBA. Filter Sub, ISA-L level 3: measured
/// best in time for their size on rendered pictures (docs/decisions/0010-png.md).
std::string encodePng(const Image& image);
/// Baseline JPEG 4:4:4 on black; quality 1..100. For fast frames.
std::string encodeJpeg(const Image& image, int quality);
/// Lossy WebP with alpha; quality 1..100.
std::string encodeWebp(const Image& image, int quality);

/// The formats that images are encoded in: rows of kFormats, in its order.
enum class Format : std::uint8_t { png, jpeg, webp };

struct FormatSpec {
    std::string_view name;     ///< as flags and parameters write it
    std::string_view mime;     ///< media type
    std::string_view endings;  ///< of file names, blank-separated, the usual one first
    bool isLossy;              ///< takes a quality
    /// First bytes of every file; '?' is any byte.
    std::string_view signature;
    /// Upper bound of a file's size without its head, used to check replies of workers.
    double maxBytesPerPixel;
    std::string (*encode)(const Image& image, int quality);
};

/// The table of formats: source of flags, parameters, content negotiation, file endings, help and
/// the OpenAPI description. Of formats with equal preference in a request the first is sent.
inline constexpr std::array kFormats{
    // Four bytes a pixel, and deflate's overhead for incompressible data.
    FormatSpec{"png", "image/png", "png", false, "\x89PNG\r\n\x1a\n", 4.5,
               [](const Image& image, int) { return encodePng(image); }},
    // Three samples of at most 18 bits each by the standard Huffman tables, as an image's energy is
    // bounded, with stuffed bytes.
    FormatSpec{"jpeg", "image/jpeg", "jpg jpeg", true, "\xFF\xD8\xFF", 8, encodeJpeg},
    // Three lossy samples and alpha.
    FormatSpec{"webp", "image/webp", "webp", true, "RIFF????WEBP", 6, encodeWebp},
};

inline constexpr Format kLastFormat{kFormats.size() - 1};

constexpr const FormatSpec& specOf(Format format) {
    return kFormats[static_cast<std::size_t>(format)];
}

std::string encode(const Image& image, Format format, int quality);
/// "image/png", "image/jpeg", "image/webp".
std::string contentType(Format format);
/// Whether `bytes` begin with a signature, in which '?' is any byte.
bool matches(std::string_view bytes, std::string_view signature);
/// Whether `bytes` begin as a file of the format does.
bool hasSignature(std::string_view bytes, Format format);
/// Joins the words of one column of kFormats: ".png, .jpg, .jpeg or .webp" of the endings with ",
/// ", " or " and the prefix ".".
std::string listFormats(std::string_view FormatSpec::*column, std::string_view separator,
                        std::string_view lastSeparator, std::string_view prefix = {});

}  // namespace farol::image
