#include <libdeflate.h>

#include <cstring>
#include <memory>
#include <stdexcept>

#include "render/encode.h"

// PNG, Portable Network Graphics Specification (W3C, 2nd edition).
namespace farol::render {
namespace {

constexpr int kLevel = 1;
constexpr std::uint8_t kFilterSub = 1;

void appendU32(std::string& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out.push_back(static_cast<char>((value >> shift) & 255U));
}

/// Closes the chunk whose length field stands at `begin`.
void finishChunk(std::string& out, std::size_t begin) {
    const std::size_t length = out.size() - begin - 8;
    for (int i = 0; i < 4; ++i)
        out[begin + static_cast<std::size_t>(i)] =
            static_cast<char>((length >> (24 - 8 * i)) & 255U);
    appendU32(out, libdeflate_crc32(0, out.data() + begin + 4, length + 4));
}

std::size_t beginChunk(std::string& out, const char* type) {
    const std::size_t begin = out.size();
    out.append(4, '\0').append(type, 4);
    return begin;
}

/// Rows with their filter byte; channels 3 or 4.
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
            from += 4;
            for (std::size_t c = 0; c < channels; ++c)
                *to++ =
                    static_cast<std::uint8_t>(from[c] - from[static_cast<std::ptrdiff_t>(c) - 4]);
        }
    }
    return rows;
}

}  // namespace

std::string encodePng(const Image& image) {
    const bool opaque = isOpaque(image);
    std::string out("\x89PNG\r\n\x1a\n", 8);
    std::size_t chunk = beginChunk(out, "IHDR");
    appendU32(out, static_cast<std::uint32_t>(image.width));
    appendU32(out, static_cast<std::uint32_t>(image.height));
    out.push_back(8);
    out.push_back(opaque ? 2 : 6);
    out.append(3, '\0');
    finishChunk(out, chunk);

    const std::vector<std::uint8_t> rows = filterRows(image, opaque ? 3 : 4);
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> deflate(
        libdeflate_alloc_compressor(kLevel), &libdeflate_free_compressor);
    if (!deflate) throw std::bad_alloc();
    chunk = beginChunk(out, "IDAT");
    const std::size_t begin = out.size();
    out.resize(begin + libdeflate_zlib_compress_bound(deflate.get(), rows.size()));
    const std::size_t length = libdeflate_zlib_compress(deflate.get(), rows.data(), rows.size(),
                                                        out.data() + begin, out.size() - begin);
    if (length == 0) throw std::runtime_error("libdeflate ran out of the bound it gave");
    out.resize(begin + length);
    finishChunk(out, chunk);
    finishChunk(out, beginChunk(out, "IEND"));
    return out;
}

}  // namespace farol::render
