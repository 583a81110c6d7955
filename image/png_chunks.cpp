#include "image/png_chunks.h"

#include <isa-l.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <future>
#include <memory>
#include <new>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

namespace farol::image::png {
namespace {

constexpr std::uint8_t kFilterSub = 1;

constexpr std::uint32_t kOutAtOnce = 256 * 1024;

/// Filtered bytes of a stripe: smaller ones compress worse, larger ones leave processors idle.
constexpr std::size_t kMinStripe = 384 * 1024;

constexpr std::size_t kMaxThreads = 4;  // of one image

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

/// Bytes of a row with its filter byte.
std::size_t rowBytes(const Image& image, std::size_t channels) {
    return 1 + static_cast<std::size_t>(image.width) * channels;
}

/// Rows with their filter byte, `count` of them from `first` on. One byte more is scratch.
Bytes filterRows(const Image& image, std::size_t channels, std::size_t first, std::size_t count) {
    const std::size_t width = static_cast<std::size_t>(image.width);
    Bytes rows = uncleared(count * rowBytes(image, channels) + 1);
    std::uint8_t* to = rows.get();
    for (std::size_t y = first; y < first + count; ++y) {
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

/// Appends raw deflate blocks (RFC 1951) that refer to no bytes before them and end with a byte.
/// Level 3 of ISA-L: decision 10.
void deflate(std::uint8_t* rows, std::size_t size, bool isLast, std::string& out) {
    // ISA-L reads its hash table before it fills it: other bytes there give other matches.
    const Bytes buffer = zeroed(ISAL_DEF_LVL3_DEFAULT);
    const auto stream = std::make_unique<isal_zstream>();
    isal_deflate_init(stream.get());
    stream->level = 3;
    stream->level_buf = buffer.get();
    stream->level_buf_size = ISAL_DEF_LVL3_DEFAULT;
    stream->gzip_flag = IGZIP_DEFLATE;
    stream->flush = isLast ? NO_FLUSH : FULL_FLUSH;
    stream->end_of_stream = isLast ? 1 : 0;
    stream->next_in = rows;
    stream->avail_in = static_cast<std::uint32_t>(size);
    const Bytes packed = uncleared(kOutAtOnce);
    do {
        stream->next_out = packed.get();
        stream->avail_out = kOutAtOnce;
        if (const int code = isal_deflate(stream.get()); code != COMP_OK)
            throw std::runtime_error("ISA-L gives up with code " + std::to_string(code));
        out.append(reinterpret_cast<const char*>(packed.get()), kOutAtOnce - stream->avail_out);
    } while (stream->avail_out == 0);
}

/// Rows that are deflated apart from the others.
struct Stripe {
    std::size_t first, count;  // rows
    std::string deflated;
    std::uint32_t adler = 1;  // of its filtered bytes
};

/// Divides the rows by the image's size alone, so that its bytes do not depend on the machine.
std::vector<Stripe> stripesOf(const Image& image, std::size_t channels) {
    const auto height = static_cast<std::size_t>(image.height);
    const std::size_t row = rowBytes(image, channels);
    const std::size_t stripes = std::clamp<std::size_t>(height * row / kMinStripe, 1, height);
    std::vector<Stripe> all;
    for (std::size_t i = 0; i < stripes; ++i) {
        const std::size_t first = height * i / stripes;
        all.push_back({first, height * (i + 1) / stripes - first, {}});
    }
    return all;
}

/// Fills in the stripes, by as many threads as can be had.
void deflateStripes(const Image& image, std::size_t channels, std::vector<Stripe>& stripes) {
    const std::size_t row = rowBytes(image, channels);
    std::atomic<std::size_t> next = 0;
    const auto work = [&] {
        for (std::size_t i = next++; i < stripes.size(); i = next++) {
            Stripe& stripe = stripes[i];
            const Bytes rows = filterRows(image, channels, stripe.first, stripe.count);
            const std::size_t size = stripe.count * row;
            stripe.adler = isal_adler32(1, rows.get(), size);
            deflate(rows.get(), size, i + 1 == stripes.size(), stripe.deflated);
        }
    };
    const std::size_t threads =
        std::min<std::size_t>({stripes.size(), std::thread::hardware_concurrency(), kMaxThreads});
    std::vector<std::future<void>> others;  // their destructors wait
    try {
        for (std::size_t i = 1; i < threads; ++i)
            others.push_back(std::async(std::launch::async, work));
    } catch (const std::system_error&) {
        // No more threads: those that there are do the rest.
    }
    work();
    for (std::future<void>& other : others) other.get();
}

/// Returns the Adler-32 checksum (RFC 1950) of two parts, one behind the other.
std::uint32_t joinAdler(std::uint32_t first, std::uint32_t second, std::uint64_t secondSize) {
    constexpr std::uint64_t kBase = 65521;
    const std::uint64_t a = first & 0xFFFFU, b = first >> 16;
    const std::uint64_t c = second & 0xFFFFU, d = second >> 16;
    // The second's sums began with 1, and with 0 of the sums of sums.
    const std::uint64_t low = (a + c + kBase - 1) % kBase;
    const std::uint64_t high = (b + d + (secondSize % kBase) * (a + kBase - 1)) % kBase;
    return static_cast<std::uint32_t>(high << 16 | low);
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
    std::vector<Stripe> stripes = stripesOf(image, static_cast<std::size_t>(channels));
    deflateStripes(image, static_cast<std::size_t>(channels), stripes);
    const std::size_t row = rowBytes(image, static_cast<std::size_t>(channels));
    out.append("\x78\x01", 2);  // zlib: deflate with a window of 32 KiB
    std::uint32_t adler = 1;
    for (const Stripe& stripe : stripes) {
        out.append(stripe.deflated);
        adler = joinAdler(adler, stripe.adler, stripe.count * row);
    }
    appendU32(out, adler);
}

}  // namespace farol::image::png
