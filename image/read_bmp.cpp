#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "image/byte_reader.h"
#include "image/decoder.h"

namespace farol::image {
namespace {

enum Compression : std::uint32_t { kPlain = 0, kRle8 = 1, kRle4 = 2, kMasks = 3, kAlphaMasks = 6 };

constexpr std::uint32_t kOs2Head = 12;

struct Head {
    std::uint32_t pixelOffset = 0, size = 0, compression = kPlain, colors = 0;
    std::int64_t width = 0, height = 0;
    bool topDown = false;
    unsigned depth = 0;                       ///< bits a pixel
    std::array<std::uint32_t, 4> masks = {};  ///< red, green, blue, alpha; 0: not in the file
    std::size_t paletteAt = 0;
};

using Color = std::array<std::uint8_t, 3>;

void readMasks(ByteReader& in, Head& head) {
    const bool bits16 = head.depth == 16;
    if (head.compression == kMasks || head.compression == kAlphaMasks) {
        const bool hasAlpha = head.size >= 56 || head.compression == kAlphaMasks;
        for (std::size_t i = 0; i < (hasAlpha ? 4U : 3U); ++i) head.masks[i] = in.u32();
    } else if (bits16) {
        head.masks = {0x7C00U, 0x03E0U, 0x001FU, 0U};
    } else {
        head.masks = {0xFF0000U, 0xFF00U, 0xFFU, head.depth == 32 ? 0xFF000000U : 0U};
    }
    for (std::size_t i = 0; i < 4; ++i) {
        const std::uint32_t mask = head.masks[i];
        if (mask == 0 && i == 3) continue;
        const std::uint32_t ones = mask == 0 ? 0 : mask >> std::countr_zero(mask);
        if (mask == 0 || (ones & (ones + 1)) != 0 || (bits16 && mask > 0xFFFFU))
            throw std::runtime_error("a colour mask is out of range");
    }
}

Head readHead(std::string_view bytes) {
    ByteReader in(bytes);
    Head head;
    in.skip(10);
    head.pixelOffset = in.u32();
    head.size = in.u32();
    static constexpr std::array<std::uint32_t, 6> kSizes{kOs2Head, 40, 52, 56, 108, 124};
    if (std::find(kSizes.begin(), kSizes.end(), head.size) == kSizes.end())
        throw std::runtime_error("a head of " + std::to_string(head.size) + " bytes is not read");
    in.requireLeft(head.size - 4);
    if (head.size == kOs2Head) {
        head.width = in.u16();
        head.height = in.u16();
    } else {
        head.width = static_cast<std::int32_t>(in.u32());
        head.height = static_cast<std::int32_t>(in.u32());
    }
    head.topDown = head.height < 0;
    head.height = std::abs(head.height);
    in.skip(2);
    head.depth = in.u16();
    if (head.size != kOs2Head) {
        head.compression = in.u32();
        in.skip(12);
        head.colors = in.u32();
        in.skip(4);
    }
    head.paletteAt = std::size_t{14} + head.size;
    const bool palette = head.depth == 1 || head.depth == 4 || head.depth == 8;
    const bool direct = head.depth == 16 || head.depth == 24 || head.depth == 32;
    const bool masks = head.compression == kMasks || head.compression == kAlphaMasks;
    const bool matches = head.compression == kPlain  ? palette || direct
                         : head.compression == kRle8 ? head.depth == 8 && !head.topDown
                         : head.compression == kRle4 ? head.depth == 4 && !head.topDown
                                                     : masks && direct && head.depth != 24;
    if (!matches)
        throw std::runtime_error(std::to_string(head.depth) + " bits a pixel with compression " +
                                 std::to_string(head.compression) + " are not read");
    if (direct) readMasks(in, head);
    return head;
}

/// The colours between head and pixels; at most one for each index.
std::vector<Color> readPalette(std::string_view bytes, const Head& head) {
    const std::size_t entry = head.size == kOs2Head ? 3 : 4;
    const std::size_t indices = std::size_t{1} << head.depth;
    std::size_t count = head.colors == 0 ? indices : std::min<std::size_t>(head.colors, indices);
    if (head.pixelOffset > head.paletteAt)
        count = std::min(count, (head.pixelOffset - head.paletteAt) / entry);
    ByteReader in(bytes);
    in.skip(head.paletteAt);
    std::vector<Color> palette(count);
    for (Color& color : palette) {
        for (const std::size_t channel : {2U, 1U, 0U}) color[channel] = in.u8();
        in.skip(entry - 3);
    }
    return palette;
}

class PaletteWriter {
  public:
    PaletteWriter(const std::vector<Color>& palette, Decoded& out) : palette_(palette), out_(out) {}

    /// `y` counts in the file's order; columns outside the image are ignored.
    void put(std::int64_t x, std::int64_t y, unsigned index, bool topDown) {
        if (x >= out_.width || y >= out_.height) return;
        if (index >= palette_.size())
            throw std::runtime_error("colour " + std::to_string(index) +
                                     " is not in its palette of " +
                                     std::to_string(palette_.size()));
        std::uint8_t* row = out_.row(static_cast<int>(topDown ? y : out_.height - 1 - y));
        std::copy(palette_[index].begin(), palette_[index].end(), row + x * 3);
    }

  private:
    const std::vector<Color>& palette_;
    Decoded& out_;
};

std::uint64_t bytesARow(const Head& head) {
    return (static_cast<std::uint64_t>(head.width) * head.depth + 31) / 32 * 4;
}

void readIndices(ByteReader& in, const Head& head, PaletteWriter& to) {
    const unsigned mask = (1U << head.depth) - 1;
    for (std::int64_t y = 0; y < head.height; ++y) {
        // The last row's padding may be missing.
        const auto used =
            static_cast<std::size_t>((static_cast<std::uint64_t>(head.width) * head.depth + 7) / 8);
        ByteReader row(in.take(used));
        in.skip(std::min<std::size_t>(in.left(), bytesARow(head) - used));
        unsigned bits = 0, left = 0;
        for (std::int64_t x = 0; x < head.width; ++x) {
            if (left == 0) {
                bits = row.u8();
                left = 8;
            }
            left -= head.depth;
            to.put(x, y, bits >> left & mask, head.topDown);
        }
    }
}

/// Runs and literal pixels (BI_RLE8, BI_RLE4); pixels that are skipped keep colour 0.
void readRle(ByteReader& in, const Head& head, PaletteWriter& to) {
    const bool nibbles = head.compression == kRle4;
    const auto indexOf = [&](unsigned byte, unsigned i) {
        return !nibbles ? byte : i % 2 == 0 ? byte >> 4U : byte & 15U;
    };
    for (std::int64_t y = 0; y < head.height; ++y)
        for (std::int64_t x = 0; x < head.width; ++x) to.put(x, y, 0, false);
    std::int64_t x = 0, y = 0;
    while (y < head.height) {
        const unsigned count = in.u8(), value = in.u8();
        if (count > 0) {
            if (x + count > head.width + 1) throw std::runtime_error("a run leaves its row");
            for (unsigned i = 0; i < count; ++i) to.put(x++, y, indexOf(value, i), false);
        } else if (value == 0) {
            x = 0;
            ++y;
        } else if (value == 1) {
            return;
        } else if (value == 2) {
            x += in.u8();
            y += in.u8();
            if (x > head.width) throw std::runtime_error("a run leaves its row");
        } else {
            if (x + value > head.width + 1) throw std::runtime_error("a run leaves its row");
            unsigned byte = 0;
            for (unsigned i = 0; i < value; ++i) {
                if (!nibbles || i % 2 == 0) byte = in.u8();
                to.put(x++, y, indexOf(byte, i), false);
            }
            const unsigned bytes = nibbles ? (value + 1) / 2 : value;
            if (bytes % 2 != 0) in.skip(1);  // to a word
        }
    }
}

std::uint8_t channelOf(std::uint32_t pixel, std::uint32_t mask) {
    const unsigned shift = static_cast<unsigned>(std::countr_zero(mask));
    const std::uint64_t largest = mask >> shift;
    return static_cast<std::uint8_t>(
        (((pixel & mask) >> shift) * std::uint64_t{255} + largest / 2) / largest);
}

void readDirect(ByteReader& in, const Head& head, Decoded& out) {
    const std::size_t used = static_cast<std::size_t>(head.width) * (head.depth / 8);
    for (std::int64_t y = 0; y < head.height; ++y) {
        ByteReader row(in.take(used));
        in.skip(std::min<std::size_t>(in.left(), bytesARow(head) - used));
        std::uint8_t* to = out.row(static_cast<int>(head.topDown ? y : head.height - 1 - y));
        for (std::int64_t x = 0; x < head.width; ++x) {
            std::uint32_t pixel = row.u16();
            if (head.depth > 16) pixel |= std::uint32_t{row.u8()} << 16U;
            if (head.depth > 24) pixel |= std::uint32_t{row.u8()} << 24U;
            for (std::size_t c = 0; c < static_cast<std::size_t>(out.channels); ++c)
                *to++ = channelOf(pixel, head.masks[c]);
        }
    }
    if (out.channels < 4) return;
    // Many programs leave the fourth byte 0 and mean an opaque image.
    bool isClear = true;
    for (std::size_t i = 3; i < out.samples.size(); i += 4) isClear &= out.samples[i] == 0;
    for (std::size_t i = 3; isClear && i < out.samples.size(); i += 4) out.samples[i] = 255;
}

}  // namespace

void readBmp(std::string_view bytes, bool wantsPixels, Decoded& out) {
    const Head head = readHead(bytes);
    if (!out.announce(head.width, head.height, head.masks[3] != 0 ? 4 : 3)) return;
    ByteReader in(bytes);
    in.skip(head.pixelOffset);
    const bool runs = head.compression == kRle8 || head.compression == kRle4;
    if (!runs) {  // the last row's padding may be missing
        const std::uint64_t row = bytesARow(head);
        const auto used = (static_cast<std::uint64_t>(head.width) * head.depth + 7) / 8;
        in.requireLeft(row * static_cast<std::uint64_t>(head.height - 1) + used);
    }
    if (!wantsPixels) return;
    const std::vector<Color> palette =
        head.depth <= 8 ? readPalette(bytes, head) : std::vector<Color>{};
    out.allocate();
    if (head.depth > 8) return readDirect(in, head, out);
    PaletteWriter to(palette, out);
    runs ? readRle(in, head, to) : readIndices(in, head, to);
}

}  // namespace farol::image
