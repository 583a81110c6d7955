#include "image/image_head.h"

namespace farol::image {
namespace {

/// `count` bytes, least first; 0 beyond the end.
std::uint32_t number(std::string_view bytes, std::size_t at, std::size_t count) {
    std::uint32_t value = 0;
    for (std::size_t i = count; i-- > 0;)
        value =
            value << 8U | (at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0U);
    return value;
}

std::int64_t area(std::uint32_t width, std::uint32_t height) {
    return std::int64_t{width} * height;
}

}  // namespace

std::int64_t announcedWebpPixels(std::string_view bytes) {
    if (bytes.size() < 30) return 0;
    const std::string_view kind = bytes.substr(12, 4);
    if (kind == "VP8X") return area(number(bytes, 24, 3) + 1, number(bytes, 27, 3) + 1);
    if (kind == "VP8L") {  // 14 bits each, after a byte of signature
        const std::uint32_t sizes = number(bytes, 21, 4);
        return area((sizes & 0x3FFFU) + 1, (sizes >> 14U & 0x3FFFU) + 1);
    }
    if (kind == "VP8 ") return area(number(bytes, 26, 2) & 0x3FFFU, number(bytes, 28, 2) & 0x3FFFU);
    return 0;
}

int countJpegScans(std::string_view bytes) {
    constexpr unsigned kScan = 0xDA, kEnd = 0xD9, kFirstRestart = 0xD0, kTemporary = 0x01;
    int scans = 0;
    for (std::size_t at = 2; (at = bytes.find('\xff', at)) < bytes.size();) {
        if (++at == bytes.size()) break;
        const unsigned marker = static_cast<unsigned char>(bytes[at]);
        if (marker == kEnd) break;
        if (marker == 0xFF) continue;
        ++at;
        // A stuffed byte of data, or a marker without a segment.
        if (marker == 0 || marker == kTemporary || (marker >= kFirstRestart && marker < kEnd))
            continue;
        if (marker == kScan) ++scans;
        if (bytes.size() - at < 2) break;
        at += std::size_t{static_cast<unsigned char>(bytes[at])} << 8U |
              static_cast<unsigned char>(bytes[at + 1]);
    }
    return scans;
}

bool isAnimatedWebp(std::string_view bytes) {
    return bytes.size() > 20 && bytes.substr(12, 4) == "VP8X" && (bytes[20] & 2) != 0;
}

bool isWholePng(std::string_view bytes) {
    constexpr std::size_t kAround = 12;  // length, type and checksum
    for (std::size_t at = 8; at <= bytes.size() && bytes.size() - at >= kAround;) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i)
            length = length << 8U | static_cast<unsigned char>(bytes[at + i]);
        if (length > bytes.size() - at - kAround) return false;
        if (bytes.substr(at + 4, 4) == "IEND") return true;
        at += kAround + length;
    }
    return false;
}

}  // namespace farol::image
