#include "image/png_chunks.h"

#include <isa-l.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>

namespace farol::image::png {
namespace {

constexpr std::uint8_t kFilterSub = 1;

constexpr std::uint32_t kOutAtOnce = 256 * 1024;

using Bytes = std::unique_ptr<std::uint8_t[]>;

/// Memory that is not zeroed first, where all of it is written before it is read.
Bytes uncleared(std::size_t size) { return Bytes(new std::uint8_t[size]); }

Bytes zeroed(std::size_t size) { return std::make_unique<std::uint8_t[]>(size); }

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
            // With three channels the next pixel overwrites the fourth byte.
            std::memcpy(to, &changed, sizeof changed);
            before = pixel;
        }
    }
    return rows;
}

/// Appends a zlib stream (RFC 1950). Level 3 of ISA-L: decision 10.
void deflate(std::uint8_t* rows, std::size_t size, std::string& out) {
    constexpr std::size_t kMaxAtOnce = std::size_t{1} << 30;  // ISA-L counts in 32 bits
    // ISA-L reads its hash table before it fills it: other bytes there give other matches.
    const Bytes buffer = zeroed(ISAL_DEF_LVL3_DEFAULT);
    const auto stream = std::make_unique<isal_zstream>();
    isal_deflate_init(stream.get());
    stream->level = 3;
    stream->level_buf = buffer.get();
    stream->level_buf_size = ISAL_DEF_LVL3_DEFAULT;
    stream->gzip_flag = IGZIP_ZLIB;
    const Bytes packed = uncleared(kOutAtOnce);
    std::size_t left = size;
    do {
        if (stream->avail_in == 0) {
            const std::size_t next = std::min(left, kMaxAtOnce);
            stream->next_in = rows + (size - left);
            stream->avail_in = static_cast<std::uint32_t>(next);
            left -= next;
            stream->end_of_stream = left == 0 ? 1 : 0;
        }
        stream->next_out = packed.get();
        stream->avail_out = kOutAtOnce;
        if (const int code = isal_deflate(stream.get()); code != COMP_OK)
            throw std::runtime_error("ISA-L gives up with code " + std::to_string(code));
        out.append(reinterpret_cast<const char*>(packed.get()), kOutAtOnce - stream->avail_out);
    } while (stream->internal_state.state != ZSTATE_END);
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
    appendU32(out, crc32_gzip_refl(0, reinterpret_cast<const std::uint8_t*>(out.data()) + begin + 4,
                                   length + 4));
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
    deflate(rows.get(), size, out);
}

}  // namespace farol::image::png
