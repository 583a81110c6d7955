#include "render/png_chunks.h"

#include <libdeflate.h>

#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>

namespace farol::render::png {
namespace {

constexpr int kLevel = 1;
constexpr std::uint8_t kFilterSub = 1;

using Bytes = std::unique_ptr<std::uint8_t[]>;

/// Memory that is not cleared first: all of it is written, and pictures are large.
Bytes uncleared(std::size_t size) { return Bytes(new std::uint8_t[size]); }

/// a - b for each of four bytes at once.
std::uint32_t differences(std::uint32_t a, std::uint32_t b) {
    constexpr std::uint32_t kTops = 0x80808080U;
    return ((a | kTops) - (b & ~kTops)) ^ ((a ^ ~b) & kTops);
}

std::uint32_t load(const std::uint8_t* from) {
    std::uint32_t value = 0;
    std::memcpy(&value, from, sizeof value);
    return value;
}

/// Rows with their filter byte: height * (1 + width * channels). One byte more is scratch.
Bytes filterRows(const Image& image, std::size_t channels) {
    const std::size_t width = static_cast<std::size_t>(image.width);
    const std::size_t height = static_cast<std::size_t>(image.height);
    Bytes rows = uncleared(height * (1 + width * channels) + 1);
    std::uint8_t* to = rows.get();
    for (std::size_t y = 0; y < height; ++y) {
        const std::uint8_t* from = &image.pixels[y * width * 4];
        *to++ = kFilterSub;
        std::uint32_t before = 0;
        for (std::size_t x = 0; x < width; ++x, from += 4, to += channels) {
            const std::uint32_t pixel = load(from);
            const std::uint32_t changed = differences(pixel, before);
            // With three channels the fourth byte is written over by what follows.
            std::memcpy(to, &changed, sizeof changed);
            before = pixel;
        }
    }
    return rows;
}

}  // namespace

void appendU16(std::string& out, std::uint32_t value) {
    out.push_back(static_cast<char>((value >> 8) & 255U));
    out.push_back(static_cast<char>(value & 255U));
}

void appendU32(std::string& out, std::uint32_t value) {
    appendU16(out, value >> 16);
    appendU16(out, value);
}

std::size_t beginChunk(std::string& out, const char* type) {
    const std::size_t begin = out.size();
    out.append(4, '\0').append(type, 4);
    return begin;
}

void finishChunk(std::string& out, std::size_t begin) {
    const std::size_t length = out.size() - begin - 8;
    std::string field;
    appendU32(field, static_cast<std::uint32_t>(length));
    out.replace(begin, 4, field);
    appendU32(out, libdeflate_crc32(0, out.data() + begin + 4, length + 4));
}

void appendHeader(std::string& out, int width, int height, int channels) {
    out.append("\x89PNG\r\n\x1a\n", 8);
    const std::size_t chunk = beginChunk(out, "IHDR");
    appendU32(out, static_cast<std::uint32_t>(width));
    appendU32(out, static_cast<std::uint32_t>(height));
    out.push_back(8);
    out.push_back(channels == 3 ? 2 : 6);
    out.append(3, '\0');
    finishChunk(out, chunk);
}

void appendPixels(std::string& out, const Image& image, int channels) {
    const std::size_t size =
        static_cast<std::size_t>(image.height) *
        (1 + static_cast<std::size_t>(image.width) * static_cast<std::size_t>(channels));
    const Bytes rows = filterRows(image, static_cast<std::size_t>(channels));
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> deflate(
        libdeflate_alloc_compressor(kLevel), &libdeflate_free_compressor);
    if (!deflate) throw std::bad_alloc();
    const std::size_t bound = libdeflate_zlib_compress_bound(deflate.get(), size);
    const Bytes packed = uncleared(bound);
    const std::size_t length =
        libdeflate_zlib_compress(deflate.get(), rows.get(), size, packed.get(), bound);
    if (length == 0) throw std::runtime_error("libdeflate ran out of the bound it gave");
    out.append(reinterpret_cast<const char*>(packed.get()), length);
}

}  // namespace farol::render::png
