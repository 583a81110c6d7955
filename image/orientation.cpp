#include "image/orientation.h"

#include <algorithm>
#include <cstdint>

namespace farol::image {
namespace {

using namespace std::string_view_literals;

/// `count` bytes as a number; 0 beyond the end.
std::uint32_t numberAt(std::string_view bytes, std::size_t at, std::size_t count, bool bigEndian) {
    if (at > bytes.size() || count > bytes.size() - at) return 0;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t k = bigEndian ? i : count - 1 - i;
        value = value << 8U | static_cast<unsigned char>(bytes[at + k]);
    }
    return value;
}

/// The tag in a block as TIFF files begin with (TIFF 6.0, section 2): byte order, place of the
/// first directory, its entries of 12 bytes.
int orientationInTiff(std::string_view block) {
    constexpr std::size_t kMaxEntries = 256;
    constexpr std::uint32_t kTag = 0x0112, kShort = 3;
    const bool big = block.starts_with("MM\0*"sv);
    if (!big && !block.starts_with("II*\0"sv)) return 1;
    const std::size_t directory = numberAt(block, 4, 4, big);
    const std::size_t entries =
        std::min<std::size_t>(numberAt(block, directory, 2, big), kMaxEntries);
    for (std::size_t i = 0; i < entries; ++i) {
        const std::size_t at = directory + 2 + 12 * i;
        if (numberAt(block, at, 2, big) != kTag) continue;
        const std::uint32_t value = numberAt(block, at + 8, 2, big);
        const bool fits = numberAt(block, at + 2, 2, big) == kShort && value >= 1 && value <= 8;
        return fits ? static_cast<int>(value) : 1;
    }
    return 1;
}

std::string_view withoutMark(std::string_view block) {
    return block.starts_with("Exif\0\0"sv) ? block.substr(6) : block;
}

/// The Exif segment of a JPEG, before its first scan (ITU T.81, annex B).
std::string_view exifOfJpeg(std::string_view bytes) {
    constexpr unsigned kScan = 0xDA, kApp1 = 0xE1;
    for (std::size_t at = 2; at + 4 <= bytes.size();) {
        const unsigned marker = static_cast<unsigned char>(bytes[at + 1]);
        if (bytes[at] != '\xff' || marker == kScan) break;
        if (marker == 0xFF) {  // filled up
            ++at;
            continue;
        }
        const std::size_t length = numberAt(bytes, at + 2, 2, true);
        if (length < 2 || length > bytes.size() - at - 2) break;
        const std::string_view segment = bytes.substr(at + 4, length - 2);
        if (marker == kApp1 && segment.starts_with("Exif\0\0"sv)) return withoutMark(segment);
        at += 2 + length;
    }
    return {};
}

/// A chunk of a file of chunks, with its type before its length (RIFF) or behind it (PNG).
std::string_view chunkOf(std::string_view bytes, std::string_view type, bool png) {
    const std::size_t around = png ? 12 : 8;  // length, type, and PNG's checksum
    for (std::size_t at = png ? 8 : 12; at <= bytes.size() && bytes.size() - at >= around;) {
        const std::size_t length = numberAt(bytes, at + (png ? 0 : 4), 4, png);
        if (length > bytes.size() - at - around) break;
        if (bytes.substr(at + (png ? 4 : 0), 4) == type) return bytes.substr(at + 8, length);
        at += around + length + (png ? 0 : length % 2);
    }
    return {};
}

/// Where the pixel of a turned image comes from.
struct Source {
    bool exchanged, mirrored, upsideDown;
};

Source sourceOf(int orientation) {
    return {orientation >= 5,
            orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8,
            orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7};
}

}  // namespace

int orientationOf(std::string_view bytes) {
    if (bytes.starts_with("\xff\xd8\xff"sv)) return orientationInTiff(exifOfJpeg(bytes));
    if (bytes.starts_with("RIFF"sv) && bytes.substr(0, 12).ends_with("WEBP"sv))
        return orientationInTiff(withoutMark(chunkOf(bytes, "EXIF", false)));
    if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv))
        return orientationInTiff(withoutMark(chunkOf(bytes, "eXIf", true)));
    return 1;
}

void orient(Decoded& image, int orientation) {
    if (orientation == 1) return;
    const Source source = sourceOf(orientation);
    const int width = source.exchanged ? image.height : image.width;
    const int height = source.exchanged ? image.width : image.height;
    std::vector<std::uint8_t> turned(image.samples.size());
    const auto channels = static_cast<std::size_t>(image.channels);
    std::size_t to = 0;
    for (int y = 0; y < height && !turned.empty(); ++y)
        for (int x = 0; x < width; ++x, to += channels) {
            int column = source.exchanged ? y : x, row = source.exchanged ? x : y;
            if (source.mirrored) column = image.width - 1 - column;
            if (source.upsideDown) row = image.height - 1 - row;
            const std::uint8_t* from = image.row(row) + static_cast<std::size_t>(column) * channels;
            std::copy(from, from + channels, &turned[to]);
        }
    image.samples = std::move(turned);
    image.width = width;
    image.height = height;
}

}  // namespace farol::image
