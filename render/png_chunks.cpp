#include "render/png_chunks.h"

#include <libdeflate.h>

#include <memory>
#include <new>
#include <stdexcept>

namespace farol::render::png {
namespace {

constexpr int kLevel = 1;
constexpr std::uint8_t kFilterSub = 1;

/// Rows with their filter byte.
std::vector<std::uint8_t> filterRows(const Image& image, std::size_t channels) {
    const std::size_t width = static_cast<std::size_t>(image.width);
    const std::size_t height = static_cast<std::size_t>(image.height);
    std::vector<std::uint8_t> rows(height * (1 + width * channels));
    std::uint8_t* to = rows.data();
    for (std::size_t y = 0; y < height; ++y) {
        const std::uint8_t* from = &image.pixels[y * width * 4];
        *to++ = kFilterSub;
        for (std::size_t c = 0; c < channels; ++c) *to++ = from[c];
        for (std::size_t x = 1; x < width; ++x) {
            const std::uint8_t* before = from;
            from += 4;
            for (std::size_t c = 0; c < channels; ++c)
                *to++ = static_cast<std::uint8_t>(from[c] - before[c]);
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
    const std::vector<std::uint8_t> rows = filterRows(image, static_cast<std::size_t>(channels));
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> deflate(
        libdeflate_alloc_compressor(kLevel), &libdeflate_free_compressor);
    if (!deflate) throw std::bad_alloc();
    const std::size_t begin = out.size();
    out.resize(begin + libdeflate_zlib_compress_bound(deflate.get(), rows.size()));
    const std::size_t length = libdeflate_zlib_compress(deflate.get(), rows.data(), rows.size(),
                                                        out.data() + begin, out.size() - begin);
    if (length == 0) throw std::runtime_error("libdeflate ran out of the bound it gave");
    out.resize(begin + length);
}

}  // namespace farol::render::png
